#include "schema/rig/chain.h"

#include <algorithm>

namespace mdof {
namespace {

constexpr std::string_view kLinear = "XYZ", kRotary = "ABC";

bool is_axis(char letter) {
  return kLinear.find(letter) != std::string_view::npos ||
         kRotary.find(letter) != std::string_view::npos;
}

tl::unexpected<Error> no_chain(std::string_view text, const std::string& why) {
  return bad_input("\"" + std::string(text) + "\" is not a kinematic chain: " + why +
                   "; write the chain from the work to the tool, such as \"w-Y-X-b-Z-t\" (w work, "
                   "b bed, t tool)");
}

std::vector<std::string> links(std::string_view text) {
  std::vector<std::string> all(1);
  for (const char c : text) {
    if (c == '-') {
      all.emplace_back();
    } else if (c != ' ') {
      all.back() += c;
    }
  }
  return all;
}

void read_travel(TomlTable& machine, ChainAxis& axis, TomlTable& travels) {
  const std::string key(1, axis.letter);
  const std::string way = travels.string(key, "+");
  if (way != "+" && way != "-") machine.reject("travel", key + " must be \"+\" or \"-\"");
  axis.against_command = way == "-";
}

}  // namespace

const ChainAxis* Chain::find(char letter) const {
  const auto found = std::find_if(axes.begin(), axes.end(),
                                  [&](const ChainAxis& axis) { return axis.letter == letter; });
  return found == axes.end() ? nullptr : &*found;
}

Result<Chain> parse_chain(std::string_view text) {
  const auto all = links(text);
  if (all.size() < 3 || all.front() != "w" || all.back() != "t")
    return no_chain(text, "a chain must begin with w and end with t");
  Chain chain;
  bool bed = false;
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const std::string& link = all[i];
    if (link == "b" && !bed) {
      bed = true;
    } else if (link.size() == 1 && is_axis(link[0]) && !chain.find(link[0])) {
      chain.axes.push_back({link[0], !bed, false});
    } else {
      return no_chain(text,
                      "\"" + link + "\" is given twice, or is not one of b, X, Y, Z, A, B, C");
    }
  }
  if (!bed) return no_chain(text, "the bed b is missing");
  for (const auto& link : all) chain.text += (chain.text.empty() ? "" : "-") + link;
  return chain;
}

Chain read_machine(TomlTable& root) {
  auto machine = root.table("machine");
  if (!machine) return {};
  const std::string text = machine->string("chain");
  auto chain = parse_chain(text);
  if (!chain) {
    machine->reject("chain", chain.error().message);
    return {};
  }
  if (auto travels = machine->table("travel"))
    for (ChainAxis& axis : chain->axes) read_travel(*machine, axis, *travels);
  return std::move(*chain);
}

std::string chain_travels_text(const Chain& chain) {
  std::string text;
  for (const ChainAxis& axis : chain.axes)
    text += (text.empty() ? "" : " ") + std::string(1, axis.letter) +
            (axis.against_command ? "-" : "+");
  return text;
}

Result<Chain> chain_from(std::string_view text, std::string_view travels) {
  if (text.empty()) return Chain{};
  MDOF_TRY(Chain chain, parse_chain(text));
  for (ChainAxis& axis : chain.axes)
    axis.against_command =
        travels.find(std::string(1, axis.letter) + "-") != std::string_view::npos;
  return chain;
}

}  // namespace mdof
