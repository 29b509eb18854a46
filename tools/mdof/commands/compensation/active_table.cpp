#include "tools/mdof/commands/compensation/active_table.h"

#include <CLI/CLI.hpp>

#include "tools/mdof/output.h"
#include "tools/mdof/stored/json_read.h"

namespace mdof::tools {

namespace {

template <class Active>
Result<std::int64_t> generation_in(const Result<Active>& active, std::int64_t table) {
  if (active) return active->table.id == table ? active->generation : 0;
  if (active.error().code == ErrorCode::not_found) return 0;
  return tl::unexpected(active.error());
}

}  // namespace

void add_expected_generation_option(CLI::App& command, std::optional<std::int64_t>& generation) {
  command
      .add_option("--expected-generation", generation,
                  "Refuse the change if the generation number of the active tables differs from "
                  "this number (mdof status prints the number)")
      ->type_name("N");
}

Result<std::int64_t> generation_of(store::Store& store, const CompensationTable& table) {
  return generation_in(store.active(table.axis), table.id);
}

Result<std::int64_t> generation_of(store::Store& store, const VolumetricTable& table) {
  return generation_in(store.active_volumetric(), table.id);
}

Status print_activation(const std::string& reply, const std::string& done,
                        const std::string& already, bool json) {
  if (json) return write_line(reply);
  simdjson::dom::parser parser;
  const auto members = parser.parse(simdjson::padded_string(reply));
  return write_line((flag(members, "changed") ? done : already) + ", generation " +
                    std::to_string(integer(members, "generation").value_or(0)));
}

}  // namespace mdof::tools
