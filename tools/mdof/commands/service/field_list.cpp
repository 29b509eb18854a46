#include "tools/mdof/commands/service/field_list.h"

#include <algorithm>
#include <vector>

#include "schema/base/toml/toml_reader.h"
#include "schema/field/field.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr const char* kHead =
    "This list explains the members of the JSON documents and the columns of the CSV files that "
    "mdof and mdofd write. If both programs write the same document, its members are the same. A "
    "name ends in the unit of its value. A name has one row; if its meaning depends on the "
    "command, the row gives each meaning. In names, {linear} is X, Y or Z; {angular} is A, B or C; "
    "{axis} is X, Y, Z, A, B or C; {small} is x, y or z; {approach} is forward, reverse or mean; "
    "{probe} is the id of a probe; {number} is a number; {figure} is the name of a result; {field} "
    "is another name of this list. Types are those of JSON; [number] is an array of numbers, a|b "
    "is a or b.";

std::string type_text(const Field& row) {
  return std::string(row.type) + (row.null.empty() ? "" : "|null");
}

std::string meaning_text(const Field& row, const std::string& meaning) {
  return meaning + (row.null.empty() ? "" : "; null: " + std::string(row.null));
}

}  // namespace

std::string field_list(std::size_t width) {
  std::vector<const Field*> rows;
  for (const Field& row : fields()) rows.push_back(&row);
  std::sort(rows.begin(), rows.end(),
            [](const Field* a, const Field* b) { return a->name < b->name; });
  TextTable table({"name", "type", "meaning"});
  for (const Field* row : rows)
    table.add(
        {std::string(row->name), type_text(*row), meaning_text(*row, std::string(row->meaning))});
  return wrapped(kHead, width) + "\n\n" + table.text(width);
}

Result<std::string> field_text(const std::string& name, std::size_t width) {
  if (const auto found = find_field(name))
    return name + ": " + type_text(*found->row) + "\n" +
           wrapped(meaning_text(*found->row, found->meaning), width) + "\n";
  std::vector<std::string> names;
  for (const Field& row : fields()) names.emplace_back(row.name);
  const std::string nearest = nearest_candidate(name, names);
  return fail(ErrorCode::usage,
              "help: unknown field \"" + name + "\"" +
                  (nearest.empty() ? "" : " (did you mean \"" + nearest + "\"?)") +
                  "; to list the fields, use: mdof help fields");
}

}  // namespace mdof::tools
