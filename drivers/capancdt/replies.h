// The command port of a capaNCDT 6200: parses replies. Pure.
//
// Source: capaNCDT 6200 operating instructions, "Commands" (6500: "Ethernet interface" for COI, GDP
// and CHI): the command is "$" command CR; every character is echoed; the reply repeats the
// command, then the result, then "OK" CR LF.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::drivers::capancdt {

struct Reply {
  bool refused = false;  // "$UNKNOWN COMMAND", "$WRONG PARAMETER"
  std::string text;      // result without command and OK; if refused, the controller's text
};
// Finds the reply to `command` ("$STI?", without CR) in all bytes received since it was sent: echo,
// rest of a welcome text, reply to another command. nullopt: not received yet. Only the reply of
// $VER may lack OK.
std::optional<Reply> find_reply(std::string_view command, std::string_view received);

struct Welcome {
  std::string name, serial;  // text after the colon in lines 2 and 3; empty: none
  int lines = 0;             // number of complete lines
};
Welcome parse_welcome(std::string_view received);

// "ANO2303025,NAMDT6220,SNO1001,...": the text after `key`; empty: no such key.
std::string field(std::string_view fields, std::string_view key);
// "1,0,2,1" of $CHS: 0 none, 1 a channel, 2 a channel with a maths function. nullopt: not such a
// list.
std::optional<std::vector<int>> parse_channel_list(std::string_view text);
// The whole text as an integer; for the reply to $STI (",960") the last number.
std::optional<int> parse_integer(std::string_view text);

// Range of a channel in the reply to $CHI, µm; nullopt: no range, or its unit is not a length. µ
// may be Latin-1, UTF-8 or "u".
std::optional<double> channel_range_um(std::string_view channel_info);

}  // namespace mdof::drivers::capancdt
