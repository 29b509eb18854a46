// HTML for print: escaped texts, tables, lists of facts.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mdof::report {

class Html {
 public:
  // What follows a tag is escaped: no text of a user becomes markup.
  void element(std::string_view tag, std::string_view text, std::string_view css_class = "");
  // Markup that this program made.
  void raw(std::string_view markup) { text_ += markup; }
  // Names and values; an empty value is left out.
  void facts(const std::vector<std::pair<std::string, std::string>>& facts);
  // `css_class` "long": its rows may be on several pages, with the head on each.
  void table(const std::vector<std::string>& head,
             const std::vector<std::vector<std::string>>& rows, std::string_view css_class = "");
  // A file that the page has in it: a link that saves `bytes` as `file_name`.
  void attachment(std::string_view text, std::string_view file_name, std::string_view media_type,
                  std::string_view bytes);
  // An SVG document, with its number as part of the page.
  void figure(std::string_view svg);

  // `pictures`: data: URLs of images are shown, as a company's head may have one.
  std::string take(std::string_view language, std::string_view title, bool pictures = false);

 private:
  std::string text_;
};

}  // namespace mdof::report
