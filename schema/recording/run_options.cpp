#include "schema/recording/run_options.h"

#include <simdjson.h>

#include <utility>

namespace mdof {

RunOptions run_options(const RunHeader& run) {
  RunOptions options;
  simdjson::dom::parser parser;
  simdjson::dom::element root, on_the_fly;
  if (parser.parse(run.provenance.options_json).get(root)) return options;
  const auto is = [&](const char* member, std::string_view word) {
    std::string_view text;
    return !root.at_pointer(member).get(text) && text == word;
  };
  if (root.at_pointer("/remove_drift").get(options.remove_drift)) options.remove_drift = false;
  options.on_the_fly = !root.at_pointer("/on_the_fly").get(on_the_fly);
  if (is("/imported/sense", "body")) options.imported.sense = PositioningSense::body;
  if (is("/imported/travel", "+")) options.imported.against_command = false;
  if (is("/imported/travel", "-")) options.imported.against_command = true;
  for (const auto& [member, limit] : {std::pair{"/imported/limit_um", &options.limit_um},
                                      {"/imported/limit_um_per_mm", &options.limit_um_per_mm}})
    if (double x = 0; !root.at_pointer(member).get(x)) *limit = x;
  simdjson::dom::array about;
  if (root.at_pointer("/imported/about").get(about)) return options;
  for (const simdjson::dom::element line : about)
    if (std::string_view text; !line.get(text)) options.about.emplace_back(text);
  return options;
}

}  // namespace mdof
