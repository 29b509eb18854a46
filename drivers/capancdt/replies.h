// The command port of a capaNCDT 6200: texts <-> meanings. Pure.
//
// Source: capaNCDT 6200 operating instructions, "Commands" (6500: "Ethernet interface" for COI, GDP
// and CHI): "$" command CR; every character is echoed; the reply repeats the command, then the
// result, then "OK" CR LF.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::drivers::capancdt {

struct Reply {
  bool refused = false;  // "$UNKNOWN COMMAND", "$WRONG PARAMETER"
  std::string text;      // the result without command and OK; of a refusal, what was said
};
// The reply to `command` ("$STI?", no CR) in all that came since it was sent: echo, rest of a
// welcome, reply to something else. None: not there yet. Only the reply of $VER may lack OK.
std::optional<Reply> find_reply(std::string_view command, std::string_view received);

struct Welcome {
  std::string name, serial;  // what follows the colon in lines 2 and 3; else empty
  int lines = 0;             // complete ones
};
Welcome parse_welcome(std::string_view received);

// "ANO2303025,NAMDT6220,SNO1001,...": the text after `key`; empty if it is not there.
std::string field(std::string_view fields, std::string_view key);
// "1,0,2,1" of $CHS: 0 none, 1 a channel, 2 a channel with a maths function. None: not such a list.
std::optional<std::vector<int>> parse_channel_list(std::string_view text);
// All of it a whole number; of $STI the last: ",960".
std::optional<int> parse_integer(std::string_view text);

// Range of a channel as $CHI states it, µm; none if it states none, or in a unit that is no length.
// µ may be Latin-1 or UTF-8, or written u.
std::optional<double> range_um_of(std::string_view channel_info);

}  // namespace mdof::drivers::capancdt
