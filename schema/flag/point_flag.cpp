#include "schema/flag/point_flag.h"

#include <algorithm>
#include <array>

namespace mdof {
namespace {

constexpr std::array kFlagNames = {
#define FLAG(flag) #flag,
#include "schema/flag/point_flags.inc"
#undef FLAG
};

}  // namespace

const char* to_string(Flag flag) {
  return kFlagNames[static_cast<std::size_t>(flag)];
}

std::string to_string(const PointFlag& flag) {
  return to_string(flag.flag) + (flag.channel.empty() ? "" : ":" + flag.channel);
}

std::string to_string(const std::vector<PointFlag>& flags) {
  std::string text;
  for (const PointFlag& flag : flags) text += (text.empty() ? "" : " ") + to_string(flag);
  return text;
}

std::vector<std::string> flag_texts(const std::vector<PointFlag>& flags) {
  std::vector<std::string> texts;
  for (const PointFlag& flag : flags) texts.push_back(to_string(flag));
  return texts;
}

Result<PointFlag> point_flag_from(std::string_view text) {
  const std::string_view name = text.substr(0, text.find(':'));
  const auto* const at = std::find(kFlagNames.begin(), kFlagNames.end(), name);
  if (at == kFlagNames.end())
    return bad_input("flag \"" + std::string(text) +
                     "\" is unknown; a newer version of mdof may have written it");
  const auto flag = static_cast<Flag>(at - kFlagNames.begin());
  return PointFlag{flag, std::string(text.substr(std::min(text.size(), name.size() + 1)))};
}

}  // namespace mdof
