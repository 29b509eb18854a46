// What to say to a command line that is wrong.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace mdof::tools {

// One sentence: what was not understood, the nearest known word, and where the help is.
std::string usage_message(CLI::App& app, const CLI::ParseError& error);

}  // namespace mdof::tools
