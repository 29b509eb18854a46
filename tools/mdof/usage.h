// The error message if the command line is wrong.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace mdof::tools {

// One sentence that states the unknown word, the most similar known word, and how to get help.
std::string usage_message(CLI::App& app, const CLI::ParseError& error);

}  // namespace mdof::tools
