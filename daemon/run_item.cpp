#include "daemon/run_item.h"

#include "daemon/words/words.h"
#include "schema/base/json_page.h"
#include "schema/base/json_writer.h"
#include "schema/imported/series.h"
#include "schema/recording/run_options.h"
#include "schema/run_json.h"

namespace mdof::daemon {
namespace {

constexpr std::size_t kNoteBytes = 1024;
constexpr std::size_t kNoticeBytes = 1024, kNoticesBytes = 8 * 1024;

// Never cuts inside a UTF-8 character.
std::string cut(const std::string& text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) --bytes;
  return text.substr(0, bytes) + " ... (cut)";
}

// The options that determine the signs of the errors of an imported run, as JSON. "" for other
// runs.
std::string imported_sense_json(const RunHeader& header) {
  if (!is_imported(header)) return "";
  const ImportedSense stated = run_options(header).imported;
  JsonWriter json;
  json.begin_object().key("imported").begin_object().field("sense", to_string(stated.sense));
  json.key("travel");
  stated.against_command ? json.value(*stated.against_command ? "-" : "+") : json.null();
  json.end_object().end_object();
  return json.take();
}

}  // namespace

RunHeader shortened(RunHeader header) {
  header.note = cut(header.note, kNoteBytes);
  header.provenance.options_json = imported_sense_json(header);
  std::size_t bytes = 0, kept = 0;
  for (; kept < header.notices.size() && bytes < kNoticesBytes; ++kept) {
    for (auto& [key, x] : header.notices[kept].values)
      if (auto* text = std::get_if<std::string>(&x)) *text = cut(*text, kNoticeBytes);
    bytes += words::text(header.notices[kept]).size();
  }
  const std::size_t more = header.notices.size() - kept;
  header.notices.resize(kept);
  if (more > 0)
    header.notices.push_back(
        notice(NoticeCode::more_notices, "", {{"count", more}, {"run", header.id}}));
  return header;
}

std::string header_item(const RunHeader& header, std::optional<std::int64_t> superseded_by) {
  const auto item = [superseded_by](const RunHeader& h, bool is_short) {
    JsonWriter json;
    json.begin_object();
    write_header_members(json, h, words::text);
    json.key("superseded_by");
    superseded_by ? json.value(*superseded_by) : json.null();
    if (is_short) json.field("shortened", true);
    json.end_object();
    return json.take();
  };
  constexpr std::size_t kMostBytes = 16 * 1024;  // Several headers of this size fit into a page.
  std::string whole = item(header, false);
  return whole.size() <= kMostBytes ? whole : item(shortened(header), true);
}

namespace {

// Run A can supersede `run`, and run B can supersede run A. Returns the last run of this chain, or
// nullopt if no run supersedes `run`.
Result<std::optional<std::int64_t>> final_superseding_run(store::Store& store, std::int64_t run) {
  std::optional<std::int64_t> last;
  for (;;) {
    MDOF_TRY(const auto by, store.superseded_by(last.value_or(run)));
    if (!by) return last;
    last = by;
  }
}

}  // namespace

Result<std::string> run_list_document(store::Store& store, const RunListRequest& request,
                                      std::size_t most_bytes,
                                      const std::function<void(RunHeader&)>& explain) {
  using Listed = store::Store::Listed;
  const Listed listed = request.all ? Listed::all : Listed::results;
  MDOF_TRY(auto headers, store.list_runs(request.offset, request.count, request.axis, listed));
  MDOF_TRY(const auto total, store.count_runs(request.axis, listed));
  std::vector<std::string> items;
  for (RunHeader& header : headers) {
    MDOF_TRY(const auto by, final_superseding_run(store, header.id));
    if (explain) explain(header);
    items.push_back(header_item(header, by));
  }
  JsonWriter json;
  json.begin_object().field("total", total).field("offset", request.offset);
  json.key("runs").begin_array();
  append_page(
      json, items, [](const std::string& item) { return item; }, most_bytes);
  json.end_array().end_object();
  return json.take();
}

}  // namespace mdof::daemon
