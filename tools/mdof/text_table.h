// Aligned columns for people, and numbers as they are written in them.
#pragma once

#include <string>
#include <vector>

namespace mdof::tools {

// Columns of numbers are set to the right, others to the left; a rule stands below the head.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> head);
  void add(std::vector<std::string> row);  // as many cells as the head has
  std::string text() const;                // lines, each with its end

 private:
  std::vector<std::vector<std::string>> rows_;  // the head first
};

std::string fixed(double x, int decimals);                           // not finite: "-"
std::string in_mm(double x_m);                                       // 4 decimals
std::string in_um(double x_m);                                       // 4 decimals
std::string in_urad(double x_rad);                                   // 3 decimals
std::string with_u(const std::string& value, const std::string& u);  // "0.0584 ± 0.0021"
std::string joined(const std::vector<std::string>& words, const char* separator = ", ");

}  // namespace mdof::tools
