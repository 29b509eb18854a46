// Writes an HTML page for printing. All texts are escaped.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mdof::report {

// The text as the content of a string in CSS, also inside an HTML element <style>.
std::string css_escaped(std::string_view text);

class Html {
 public:
  // Writes <tag>text</tag>. The text is escaped; a user's text therefore cannot contain markup.
  void element(std::string_view tag, std::string_view text, std::string_view css_class = "");
  // Appends markup that this program generated.
  void raw(std::string_view markup) { text_ += markup; }
  // Writes a list of names and values. Pairs with an empty value are omitted.
  void facts(const std::vector<std::pair<std::string, std::string>>& facts);
  // `head`: titles of the columns. `css_class` "long": the table may extend over several pages;
  // each page repeats the titles.
  void table(const std::vector<std::string>& head,
             const std::vector<std::vector<std::string>>& rows, std::string_view css_class = "");
  // Writes a link with which a reader saves `bytes` as the file `file_name`. The page contains the
  // bytes.
  void attachment(std::string_view text, std::string_view file_name, std::string_view media_type,
                  std::string_view bytes);
  // Inserts the element "svg" of an SVG document into the page.
  void figure(std::string_view svg);

  // Returns the complete page. `pictures`: the page may show images from data: URLs, for example
  // the logo of a company.
  // `style`: CSS of this document.
  std::string take(std::string_view language, std::string_view title, bool pictures = false,
                   std::string_view style = "");

 private:
  std::string text_;
};

}  // namespace mdof::report
