// Writes figures of the errors of a run as nested objects: {"EYX_um": {"forward": {...}, ...},
// ...}.
#pragma once

#include <string>
#include <vector>

#include "schema/base/json_writer.h"

namespace mdof {

// A Figure has an error_key and an approach; write_figure() writes the members of its object.
template <class Figure, class Write>
void write_by_key(JsonWriter& json, const std::vector<Figure>& figures, Write write_figure) {
  json.begin_object();
  std::vector<std::string> done;
  for (const auto& first : figures) {
    bool again = false;
    for (const auto& key : done) again = again || key == first.error_key;
    if (again) continue;
    done.push_back(first.error_key);
    json.key(first.error_key).begin_object();
    for (const auto& figure : figures) {
      if (figure.error_key != first.error_key) continue;
      json.key(figure.approach).begin_object();
      write_figure(figure);
      json.end_object();
    }
    json.end_object();
  }
  json.end_object();
}

}  // namespace mdof
