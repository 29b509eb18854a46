#include "daemon/run_item.h"

#include "schema/base/json_writer.h"
#include "schema/run_json.h"

namespace mdof::daemon {
namespace {

constexpr std::size_t kNoteBytes = 1024;
constexpr std::size_t kWarningBytes = 1024, kWarningsBytes = 8 * 1024;

// At a place where no character of UTF-8 is cut in two.
std::string cut(const std::string& text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) --bytes;
  return text.substr(0, bytes) + " ... (cut)";
}

}  // namespace

RunHeader shortened(RunHeader header) {
  header.note = cut(header.note, kNoteBytes);
  header.provenance.options_json.clear();
  std::size_t bytes = 0, kept = 0;
  for (; kept < header.warnings.size() && bytes < kWarningsBytes; ++kept) {
    header.warnings[kept] = cut(header.warnings[kept], kWarningBytes);
    bytes += header.warnings[kept].size();
  }
  const std::size_t more = header.warnings.size() - kept;
  header.warnings.resize(kept);
  if (more > 0)
    header.warnings.push_back("and " + std::to_string(more) + " more warnings; mdof show " +
                              std::to_string(header.id) + " has them all");
  return header;
}

std::string header_item(const RunHeader& header) {
  const auto item = [](const RunHeader& h, bool is_short) {
    JsonWriter json;
    json.begin_object();
    write_header_members(json, h);
    if (is_short) json.field("shortened", true);
    json.end_object();
    return json.take();
  };
  constexpr std::size_t kMostBytes = 16 * 1024;  // so that a page is never one run's alone
  std::string whole = item(header, false);
  return whole.size() <= kMostBytes ? whole : item(shortened(header), true);
}

}  // namespace mdof::daemon
