#include "schema/field/shape.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <vector>

#include "schema/base/json_writer.h"
#include "schema/field/field.h"

namespace mdof {
namespace {

struct NamedShape {
  std::string_view name, text;
};
constexpr NamedShape kNamedShapes[] = {
#define SHAPE(name, text) {#name, text},
#include "schema/field/shapes.inc"
#undef SHAPE
};

constexpr std::string_view kScalars[] = {"number", "integer", "string", "boolean", "null"};

[[noreturn]] void shape_bug([[maybe_unused]] std::string_view what) {
  assert(false && "a shape that cannot be read");
  std::abort();
}

// One of the possible types of a value.
struct ShapeAlternative {
  std::string type;
  std::string keywords;  // ,"items":...; keywords for this type only
};
using ShapeType = std::vector<ShapeAlternative>;

struct ShapeMembers {
  std::vector<std::pair<std::string, std::string>> properties, patterns;  // name, schema
  std::vector<std::string> required;
  std::size_t families = 0;  // number of names with groups; each stands for one or more members
  std::string others = "false";
};

std::string schema_of(const ShapeType& type, std::string_view description = {});

std::size_t count_of(const ShapeType& type, std::string_view name) {
  return static_cast<std::size_t>(std::count_if(
      type.begin(), type.end(), [&](const ShapeAlternative& a) { return a.type == name; }));
}

class ShapeReader {
 public:
  explicit ShapeReader(std::string_view text) : rest_(text) {}

  ShapeType whole() {
    ShapeType type = read_type();
    skip_blanks();
    if (!rest_.empty()) shape_bug(rest_);
    return type;
  }
  void read_members(ShapeMembers& members, bool optional);

 private:
  void skip_blanks() {
    while (rest_.starts_with(' ')) rest_.remove_prefix(1);
  }
  bool take(std::string_view token) {
    skip_blanks();
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  void expect(std::string_view token) {
    if (!take(token)) shape_bug(rest_);
  }
  std::string_view read_name();  // including groups
  ShapeType read_type();
  void add_alternative(ShapeType& type);
  void read_member(ShapeMembers& members, bool optional);
  void read_others(ShapeMembers& members);

  std::string_view rest_;
};

std::string_view shape_named(std::string_view name) {
  const auto found = std::find_if(std::begin(kNamedShapes), std::end(kNamedShapes),
                                  [&](const NamedShape& shape) { return shape.name == name; });
  if (found == std::end(kNamedShapes)) shape_bug(name);
  return found->text;
}

std::string_view ShapeReader::read_name() {
  skip_blanks();
  std::size_t end = 0;
  for (bool group = false; end < rest_.size(); ++end) {
    const char c = rest_[end];
    if (c == '{' || c == '}') {
      if (group == (c == '{')) break;
      group = c == '{';
    } else if (std::string_view(" ,:?!|[]").find(c) != std::string_view::npos) {
      break;
    }
  }
  if (end == 0) shape_bug(rest_);
  const std::string_view name = rest_.substr(0, end);
  rest_.remove_prefix(end);
  return name;
}

ShapeType ShapeReader::read_type() {
  ShapeType type;
  do add_alternative(type);
  while (take("|"));
  return type;
}

std::string object_keywords(const ShapeMembers& members) {
  JsonWriter json;
  const auto write = [&](const char* key, const auto& named, const auto& name_of) {
    if (named.empty()) return;
    json.key(key).begin_object();
    for (const auto& [name, schema] : named) json.key(name_of(name)).raw(schema);
    json.end_object();
  };
  json.begin_object();
  write("properties", members.properties, [](const std::string& name) { return name; });
  write("patternProperties", members.patterns,
        [](const std::string& name) { return field_regex(name); });
  if (!members.required.empty()) {
    json.key("required").begin_array();
    for (const std::string& name : members.required) json.value(name);
    json.end_array();
  }
  if (members.families > 0)
    json.field("minProperties",
               static_cast<std::uint64_t>(members.required.size() + members.families));
  json.key("additionalProperties").raw(members.others).end_object();
  std::string text = json.take();
  text.pop_back();
  return "," + text.substr(1);
}

void ShapeReader::add_alternative(ShapeType& type) {
  if (take("[")) {
    const ShapeType items = read_type();
    expect("]");
    type.push_back({"array", ",\"items\":" + schema_of(items)});
  } else if (take("{")) {
    ShapeMembers members;
    read_members(members, false);
    expect("}");
    type.push_back({"object", object_keywords(members)});
  } else if (const std::string_view name = read_name();
             name == "object" || std::count(std::begin(kScalars), std::end(kScalars), name) > 0) {
    type.push_back({std::string(name), ""});
  } else {
    for (ShapeAlternative& each : ShapeReader(shape_named(name)).whole())
      type.push_back(std::move(each));
  }
}

void ShapeReader::read_members(ShapeMembers& members, bool optional) {
  skip_blanks();
  if (rest_.starts_with('}')) return;  // an empty object
  do {
    if (take("...")) {
      ShapeReader named(shape_named(read_name()));
      const bool absent = take("?");
      named.expect("{");
      named.read_members(members, optional || absent);
      named.expect("}");
    } else if (take("*")) {
      read_others(members);
    } else {
      read_member(members, optional);
    }
  } while (take(","));
}

void ShapeReader::read_others(ShapeMembers& members) {
  members.others = take(":") ? schema_of(read_type()) : "true";
}

// Returns the type of the row without "object", because only a shape states the members of an
// object.
ShapeType type_of_row(const Field& row) {
  ShapeType type = ShapeReader(row.type).whole();
  if (type.size() > 1)
    std::erase_if(type, [](const ShapeAlternative& a) { return a.type == "object"; });
  return type;
}

void ShapeReader::read_member(ShapeMembers& members, bool optional) {
  const std::string name(read_name());
  optional = take("?") || optional;
  const bool never_null = take("!");
  const auto field = find_field(name);
  if (!field) shape_bug(name);
  ShapeType type = take(":") ? read_type() : type_of_row(*field->row);
  std::string description = field->meaning;
  if (!never_null && !field->row->null.empty()) {
    if (count_of(type, "null") == 0) type.push_back({"null", ""});
    description += "; null: " + std::string(field->row->null);
  }
  const bool family = name.find('{') != std::string::npos;
  auto& named = family ? members.patterns : members.properties;
  if (std::any_of(named.begin(), named.end(), [&](const auto& each) { return each.first == name; }))
    shape_bug(name);  // the name occurs twice
  named.emplace_back(name, schema_of(type, description));
  if (optional) return;
  family ? void(++members.families) : members.required.push_back(name);
}

std::string with_meaning(std::string schema, std::string_view description) {
  if (description.empty()) return schema;
  schema.pop_back();
  return schema + ",\"description\":" + JsonWriter().value(description).take() + "}";
}

std::string any_of(const ShapeType& type) {
  JsonWriter json;
  json.begin_object().key("anyOf").begin_array();
  for (const ShapeAlternative& each : type) json.raw(schema_of({each}));
  return json.end_array().end_object().take();
}

// One schema can describe an object and an array, because the keywords of objects and arrays
// differ.
std::string schema_of(const ShapeType& type, std::string_view description) {
  if (count_of(type, "object") > 1 || count_of(type, "array") > 1)
    return with_meaning(any_of(type), description);
  JsonWriter types;
  if (type.size() > 1) types.begin_array();
  for (const ShapeAlternative& each : type) types.value(each.type);
  if (type.size() > 1) types.end_array();
  std::string schema = "{\"type\":" + types.take();
  for (const ShapeAlternative& each : type) schema += each.keywords;
  return with_meaning(schema + "}", description);
}

}  // namespace

std::string json_schema(std::string_view shape) {
  return schema_of(ShapeReader(shape).whole());
}

}  // namespace mdof
