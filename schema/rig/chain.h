// Kinematic chain of the machine, from the work to the tool: "w-Y-X-b-Z-t". w: work; b: bed; t:
// tool. The axes between w and b move the work; the axes between b and t move the tool.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof {

struct ChainAxis {
  char letter = 'X';          // X Y Z: linear axis; A B C: rotary axis
  bool carries_work = false;  // true: the axis moves the work; false: the tool
  // travel = "-": the body of the axis moves in the - direction when the command increases.
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

// The error states what is wrong in the text, with an example.
Result<Chain> parse_chain(std::string_view text);

// Reads [machine] of a rig or a configuration: chain = "w-Y-X-b-Z-t", and travel = { X = "-" } for
// the axes that move in the - direction when their command increases. If [machine] is absent, the
// chain is unknown.
Chain read_machine(TomlTable& root);

// Text with the travel of each axis: "X+ Y-". It is displayed, and it is part of the hash of a
// table.
std::string chain_travels_text(const Chain& chain);
// Makes the chain from the stored texts Chain::text and chain_travels_text().
Result<Chain> chain_from(std::string_view text, std::string_view travels);

}  // namespace mdof
