// Quotes names in commands that mdof shows to users.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string>

namespace mdof::words {

// One word of a shell command in quotes: 'O'\''Neil'.
inline std::string quoted_for_shell(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// As quoted_for_shell(), but without quotes if the shell needs none.
inline std::string shell_word(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::strchr("/._-+:@%,=", c) != nullptr || c >= 128;
  });
  return plain ? word : quoted_for_shell(word);
}

}  // namespace mdof::words
