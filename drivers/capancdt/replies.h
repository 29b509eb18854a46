// The command port of a capaNCDT 6200: parses replies. Pure.
//
// Source: capaNCDT 6200 operating instructions, "Commands" (for COI, GDP and CHI: capaNCDT 6500,
// "Ethernet interface"). A command is "$" command CR. The controller echoes every character. The
// reply contains the command, the result, and "OK" CR LF.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::drivers::capancdt {

struct Reply {
  bool refused = false;  // "$UNKNOWN COMMAND", "$WRONG PARAMETER"
  std::string text;  // the result, without the command and OK; if refused, the controller's text
};
// Finds the reply to `command` ("$STI?", without CR) in `received`, all bytes that were received
// after the command was sent. These bytes may also contain the echo, the rest of a welcome text, or
// the reply to another command. nullopt: the reply was not received yet. A reply without OK is
// accepted for $VER only.
std::optional<Reply> find_reply(std::string_view command, std::string_view received);

struct Welcome {
  std::string name, serial;  // text after the colon in lines 2 and 3; empty: no such text
  int lines = 0;             // number of complete lines
};
Welcome parse_welcome(std::string_view received);

// Returns the text after `key` in "ANO2303025,NAMDT6220,SNO1001,..."; empty: no such key.
std::string field(std::string_view fields, std::string_view key);
// Parses the reply "1,0,2,1" of $CHS. 0: no channel; 1: a channel; 2: a channel with a maths
// function. nullopt: the text is not such a list.
std::optional<std::vector<int>> parse_channel_list(std::string_view text);
// Parses the whole text as an integer. The reply to $STI (",960") is a list; its last number is
// returned.
std::optional<int> parse_integer(std::string_view text);

// Range of a channel, µm, from the reply to $CHI; nullopt: the reply has no range, or its unit is
// not a length. The character µ may be Latin-1, UTF-8 or "u".
std::optional<double> channel_range_um(std::string_view channel_info);

}  // namespace mdof::drivers::capancdt
