// The message for a wrong command line.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace mdof::tools {

// One sentence: the word that is not known, the nearest known word, and where the help is.
std::string usage_message(CLI::App& app, const CLI::ParseError& error);

}  // namespace mdof::tools
