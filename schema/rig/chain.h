// Kinematic chain of the machine, from the work to the tool: "w-Y-X-b-Z-t". w work, b bed, t tool.
// Axes between w and b move the work, axes between b and t move the tool.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof {

struct ChainAxis {
  char letter = 'X';          // X Y Z linear, A B C rotary
  bool carries_work = false;  // else it moves the tool
  // travel "-": its body moves in the - direction when the command increases.
  bool against_command = false;
  bool operator==(const ChainAxis&) const = default;
};

struct Chain {
  std::string text;             // empty: unknown
  std::vector<ChainAxis> axes;  // from w to t

  bool known() const { return !text.empty(); }
  const ChainAxis* find(char letter) const;
  bool operator==(const Chain&) const = default;
};

// Error: what is wrong with the text, with an example.
Result<Chain> parse_chain(std::string_view text);

// [machine] of a rig or a configuration: chain = "w-Y-X-b-Z-t", and travel = { X = "-" } for axes
// that do not move in the + direction when their command increases. Absent: unknown chain.
Chain read_machine(TomlTable& root);

// "X+ Y-": the travel of each axis, for people and for the hash of a table.
std::string chain_travels_text(const Chain& chain);
// Reads both stored texts; the inverse of Chain::text and chain_travels_text().
Result<Chain> chain_from(std::string_view text, std::string_view travels);

}  // namespace mdof
