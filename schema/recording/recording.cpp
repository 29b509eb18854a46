#include "schema/recording/recording.h"

#include "schema/base/sha256.h"

namespace mdof {
namespace {

void add(std::string& text, std::string_view field) {
  text.append(field).push_back('\n');
}

template <class Integer>
void add(std::string& text, Integer x) {
  add(text, std::string_view(std::to_string(x)));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> entries(const RecordingHeader& header) {
  std::vector<std::pair<std::string, std::string>> rows = {
      {"format_version", std::to_string(header.format)},
      {"software_version", header.software_version},
      {"rig", header.rig_text},
      {"devices", header.devices},
      {"configuration", header.configuration},
      {"started_utc", header.started_utc},
      {"simulated", header.simulated ? "1" : "0"},
  };
  if (header.format >= 2) rows.emplace_back("request", header.request);
  return rows;
}

std::string sha256_of(const RecordingHeader& header) {
  std::string text;
  for (const auto& [key, value] : entries(header)) {
    add(text, std::string_view(key));
    add(text, value.size());
    add(text, std::string_view(value));
  }
  return sha256_hex(text);
}

std::string sha256_of(const RecordingChunk& chunk, std::string_view previous) {
  std::string text;
  add(text, previous);
  add(text, chunk.seq);
  add(text, std::string_view(chunk.device));
  add(text, chunk.first_ns);
  add(text, chunk.last_ns);
  add(text, chunk.scans);
  add(text, chunk.lost);
  Sha256 hash;
  hash.update(text);
  hash.update(chunk.payload);
  return hash.hex();
}

std::string sha256_of(const RecordingSeal& seal, std::string_view last_chunk) {
  std::string text;
  add(text, last_chunk);
  add(text, seal.chunks);
  add(text, seal.scans);
  add(text, seal.lost);
  return sha256_hex(text + seal.finished_utc);
}

}  // namespace mdof
