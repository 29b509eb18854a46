#include "schema/field/field.h"

#include <algorithm>
#include <cassert>

namespace mdof {
namespace {

constexpr Field kFields[] = {
#define FIELD(name, type, null, meaning) {name, type, null, meaning},
#include "schema/field/names/calibration.inc"
#include "schema/field/names/controller.inc"
#include "schema/field/names/errors.inc"
#include "schema/field/names/form.inc"
#include "schema/field/names/geometry.inc"
#include "schema/field/names/iso230.inc"
#include "schema/field/names/machine.inc"
#include "schema/field/names/milling.inc"
#include "schema/field/names/part.inc"
#include "schema/field/names/run.inc"
#include "schema/field/names/separation.inc"
#include "schema/field/names/service.inc"
#include "schema/field/names/study.inc"
#include "schema/field/names/table.inc"
#include "schema/field/names/uncertainty.inc"
// These rows are last, because a probe may have any name.
#include "schema/field/names/csv.inc"
#undef FIELD
};

constexpr std::string_view kAnyField = "{field}";

struct FieldGroup {
  std::string_view name, words;
};
constexpr FieldGroup kFieldGroups[] = {{"{linear}", "X|Y|Z"},
                                       {"{angular}", "A|B|C"},
                                       {"{axis}", "X|Y|Z|A|B|C"},
                                       {"{small}", "x|y|z"},
                                       {"{approach}", "forward|reverse|mean"}};

const FieldGroup* group_at(std::string_view pattern) {
  const auto found = std::find_if(std::begin(kFieldGroups), std::end(kFieldGroups),
                                  [&](const FieldGroup& g) { return pattern.starts_with(g.name); });
  return found == std::end(kFieldGroups) ? nullptr : found;
}

std::string_view word_at(const FieldGroup& group, std::string_view name) {
  for (std::string_view rest = group.words; !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find('|'));
    if (name.starts_with(word)) return word;
    rest.remove_prefix(std::min(rest.size(), word.size() + 1));
  }
  return {};
}

struct Characters {
  std::string_view name, first, others;
};
constexpr Characters kCharacters[] = {{"{probe}", "ABCDEFGHIJKLMNOPQRSTUVWXYZ", "0123456789"},
                                      {"{number}", "0123456789", "0123456789."}};

bool matches(std::string_view pattern, std::string_view name) {
  if (pattern == kAnyField) return find_field(name).has_value();
  if (pattern.empty() || name.empty()) return pattern.empty() && name.empty();
  if (const FieldGroup* group = group_at(pattern)) {
    const std::string_view word = word_at(*group, name);
    return !word.empty() && matches(pattern.substr(group->name.size()), name.substr(word.size()));
  }
  for (const Characters& any : kCharacters)
    if (pattern.starts_with(any.name)) {
      const std::size_t end = std::min(name.find_first_not_of(any.others, 1), name.size());
      return any.first.find(name.front()) != std::string_view::npos &&
             matches(pattern.substr(any.name.size()), name.substr(end));
    }
  return pattern.front() == name.front() && matches(pattern.substr(1), name.substr(1));
}

KnownField known_field(const Field& row, std::string_view name) {
  std::string meaning(row.meaning);
  if (const std::size_t at = meaning.find(kAnyField); at != std::string::npos && row.name != name)
    meaning.replace(at, kAnyField.size(), name.substr(row.name.find(kAnyField)));
  return {&row, std::move(meaning)};
}

}  // namespace

std::span<const Field> fields() {
  return kFields;
}

std::optional<KnownField> find_field(std::string_view name) {
  for (const Field& row : kFields)
    if (row.name == name) return known_field(row, name);
  for (const bool with_rest : {false, true})
    for (const Field& row : kFields)
      if (row.name.ends_with(kAnyField) == with_rest && matches(row.name, name))
        return known_field(row, name);
  return std::nullopt;
}

std::string field_regex(std::string_view name) {
  constexpr std::string_view figure = "{figure}";
  std::string regex = "^";
  while (!name.empty()) {
    if (const FieldGroup* group = group_at(name)) {
      regex += "(" + std::string(group->words) + ")";
      name.remove_prefix(group->name.size());
    } else if (name.starts_with(figure)) {
      regex += "E[XYZABC]0?[XYZABC]_[A-Za-z_]+";
      name.remove_prefix(figure.size());
    } else {
      assert(name.front() != '{' && "a group without a regular expression");
      regex += name.front();
      name.remove_prefix(1);
    }
  }
  return regex + "$";
}

}  // namespace mdof
