#include "daemon/measure/gate/table_documents.h"

#include <algorithm>

#include "daemon/measure/gate/active_json.h"
#include "daemon/words/words.h"
#include "schema/base/json_page.h"
#include "schema/run_json.h"
#include "schema/volumetric/volumetric_json.h"

namespace mdof::daemon {
namespace {

// Writes the members "offset" and "points" of an open object. `total`: number of points of the
// table.
template <class Write>
void write_points(JsonWriter& json, std::size_t total, const DocumentPage& page, Write write) {
  json.field("offset", page.offset).key("points").begin_array();
  const std::int64_t size = static_cast<std::int64_t>(total);
  const std::int64_t begin = std::min(page.offset, size);
  const std::int64_t end = begin + std::min(page.count, size - begin);
  append_page_by_index(
      json, static_cast<std::size_t>(begin), static_cast<std::size_t>(end),
      [&](std::size_t i) {
        JsonWriter row;
        write(row, i);
        return row.take();
      },
      page.most_bytes);
  json.end_array();
}

template <class Write>
std::string item(std::int64_t generation, Write write) {
  JsonWriter json;
  json.begin_object();
  write(json);
  write_active(json, generation);
  return json.end_object().take();
}

void write_list(JsonWriter& json, const char* key, const std::vector<std::string>& items,
                std::size_t most) {
  json.key(key).begin_array();
  for (std::size_t i = 0; i < std::min(most, items.size()); ++i) json.raw(items[i]);
  json.end_array();
}

// The number of items of each list that fit into the page; at least one.
std::size_t entries_that_fit(const std::vector<std::string>& a, const std::vector<std::string>& b,
                             std::size_t most_bytes) {
  const std::size_t longest = std::max(a.size(), b.size());
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < longest; ++i) {
    for (const auto* list : {&a, &b})
      if (i < list->size()) bytes += (*list)[i].size() + 1;
    if (i > 0 && bytes > most_bytes) return i;
  }
  return longest;
}

}  // namespace

DocumentPage page_with_notices(const Notices& notices, std::int64_t count) {
  const std::size_t bytes = with_notices("{}", notices, words::text).size();
  return {0, count, kPageBytes - std::min(kPageBytes / 2, bytes)};
}

std::string table_document(const CompensationTable& table, std::int64_t generation, bool doubtful,
                           const DocumentPage& page) {
  JsonWriter json;
  json.begin_object();
  write_table_members(json, table);
  json.field("doubtful", doubtful);
  write_active(json, generation);
  write_points(json, table.position_m.size(), page,
               [&](JsonWriter& row, std::size_t i) { write_table_row(row, table, i); });
  return json.end_object().take();
}

std::string volumetric_document(const VolumetricTable& table, std::int64_t generation,
                                bool doubtful, const DocumentPage& page) {
  JsonWriter json;
  json.begin_object();
  write_volumetric_members(json, table);
  json.field("doubtful", doubtful);
  write_active(json, generation);
  write_points(json, table.nodes(), page, [&](JsonWriter& row, std::size_t node) {
    write_volumetric_node(row, table, node, true);
  });
  return json.end_object().take();
}

std::string list_document(const ListedTables& list, std::size_t most_bytes) {
  std::vector<std::string> tables, volumes;
  for (std::size_t i = 0; i < list.tables.size(); ++i)
    tables.push_back(item(list.generations[i],
                          [&](JsonWriter& json) { write_table_members(json, list.tables[i]); }));
  for (std::size_t i = 0; i < list.volumes.size(); ++i)
    volumes.push_back(item(list.volume_generations[i], [&](JsonWriter& json) {
      write_volumetric_members(json, list.volumes[i]);
    }));
  const std::size_t most = entries_that_fit(tables, volumes, most_bytes);
  JsonWriter json;
  json.begin_object().field("generation", list.generation).field("offset", list.offset);
  write_list(json, "tables", list.only_volumes ? volumes : tables, most);
  write_list(json, "volumes", list.only_volumes ? std::vector<std::string>() : volumes, most);
  return json.end_object().take();
}

}  // namespace mdof::daemon
