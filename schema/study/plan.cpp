#include "schema/study/plan.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "schema/axis.h"
#include "schema/base/number/number_text.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/study/plan_parts.h"

namespace mdof {
namespace plan_parts {

std::string known_words_hint(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest_candidate(word, known);
  if (!near.empty()) return "did you mean \"" + near + "\"?";
  std::string list = "possible:";
  for (const auto& k : known) list += " " + k;
  return list;
}

std::uint64_t read_count(TomlTable& table, std::string_view key, std::uint64_t fallback,
                         std::int64_t least, std::int64_t most) {
  const std::int64_t n = table.integer(key, static_cast<std::int64_t>(fallback));
  if (n < least || n > most)
    table.reject(key, "must be from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<std::uint64_t>(n);
}

double read_share(TomlTable& table, std::string_view key, double fallback) {
  const double p = table.number(key, fallback);
  if (!(p > 0 && p < 1)) table.reject(key, "must be more than 0 and less than 1");
  return p;
}

double read_above_zero(TomlTable& table, std::string_view key, double fallback) {
  const double x = table.number(key, fallback);
  if (!(x > 0)) table.reject(key, "must be greater than zero, not " + plain_number(x));
  return x;
}

Rig read_rig(TomlTable& table, std::string_view key, const std::filesystem::path& folder) {
  const std::string file = table.string(key);
  if (file.empty()) {
    table.reject(key, "must be the name of a rig file");
    return {};
  }
  auto rig = load_rig(folder / file);
  if (!rig) {
    table.reject(key, rig.error().message);
    return {};
  }
  return std::move(*rig);
}

}  // namespace plan_parts

namespace {

using namespace plan_parts;
using Path = std::filesystem::path;

// Returns the index of the word at `key` in the list of choices. Returns `fallback` if the word is
// missing or invalid; an invalid word is also rejected.
std::size_t read_choice(TomlTable& table, std::string_view key,
                        const std::vector<std::string>& choices, std::size_t fallback) {
  const std::string word = table.string(key, choices[fallback]);
  const auto found = std::find(choices.begin(), choices.end(), word);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  table.reject(key, "\"" + word + "\" is unknown; " + known_words_hint(word, choices));
  return fallback;
}

void read_head(TomlTable& table, const Path& folder, StudyPlan& plan) {
  plan.name = table.string("name");
  plan.rig = read_rig(table, "rig", folder);
  if (auto squareness = table.table("squareness")) {
    plan.rig_y = read_rig(*squareness, "rig_y", folder);
    if (plan.rig.axis != Axis::x || plan.rig_y->axis != Axis::y)
      squareness->reject(
          "rig_y",
          "squareness needs a rig of axis X (key \"rig\") and a rig of axis Y (key \"rig_y\")");
  }
  plan.model = static_cast<Model>(read_choice(table, "model", {"simplified", "exact", "rigid"}, 1));
  plan.forward = static_cast<Forward>(read_choice(table, "forward", {"rigid", "small-angle"}, 0));
  plan.zero_at_start = table.boolean("zero_at_start", true);
  plan.trials = read_count(table, "trials", plan.trials, 1, 1'000'000'000'000'000);
  plan.seed = read_count(table, "seed", plan.seed, 0, std::numeric_limits<std::int64_t>::max());
  plan.coverage = read_share(table, "coverage", plan.coverage);
  plan.whole_run = read_choice(table, "output_of", {"point", "run"}, 0) == 1;
}

}  // namespace

Result<StudyPlan> parse_study_plan(std::string_view toml_text, const std::string& source_name) {
  MDOF_TRY(auto table, TomlTable::parse(toml_text, source_name));
  const Path folder = Path(source_name).parent_path();
  StudyPlan plan;
  plan.source = source_name;
  plan.text = std::string(toml_text);
  read_head(table, folder, plan);
  if (plan.rig.probes.empty()) return tl::unexpected(table.finish().error());
  read_outputs(table, plan);
  MDOF_CHECK(read_quantities(table, folder, plan));
  read_dependence(table, plan);
  read_settings(table, plan);
  read_analyses(table, folder, plan);
  MDOF_CHECK(table.finish());
  return plan;
}

}  // namespace mdof
