// Writes HTML for print: escaped texts, tables, lists of facts.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mdof::report {

class Html {
 public:
  // The text is escaped, so that a user's text never becomes markup.
  void element(std::string_view tag, std::string_view text, std::string_view css_class = "");
  // Appends markup that this program generated.
  void raw(std::string_view markup) { text_ += markup; }
  // Names and values; entries with an empty value are left out.
  void facts(const std::vector<std::pair<std::string, std::string>>& facts);
  // `css_class` "long": the table may extend over several pages, with its head on each page.
  void table(const std::vector<std::string>& head,
             const std::vector<std::vector<std::string>>& rows, std::string_view css_class = "");
  // A link that saves `bytes`, which the page contains, as `file_name`.
  void attachment(std::string_view text, std::string_view file_name, std::string_view media_type,
                  std::string_view bytes);
  // Inserts an SVG document into the page, without the text before its element "svg".
  void figure(std::string_view svg);

  // `pictures`: show images from data: URLs, for example in the company's head.
  std::string take(std::string_view language, std::string_view title, bool pictures = false);

 private:
  std::string text_;
};

}  // namespace mdof::report
