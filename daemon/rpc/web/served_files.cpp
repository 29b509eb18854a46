#include "daemon/rpc/web/served_files.h"

#include <zlib.h>

#include <array>
#include <cassert>

#include "schema/base/sha256.h"

namespace mdof::rpc {
namespace {

struct FileType {
  std::string_view ending, type;
};

constexpr std::array<FileType, 6> kFileTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".svg", "image/svg+xml"},
    {".json", "application/json"},
    {".webmanifest", "application/manifest+json"},
}};

std::string_view type_of(std::string_view name) {
  for (const FileType& row : kFileTypes)
    if (name.ends_with(row.ending)) return row.type;
  assert(false && "a file of the web page has an unknown extension");
  return "application/octet-stream";
}

// The text compressed by gzip, without a time or file name; empty if it would not be shorter.
std::string compressed(std::string_view text) {
  constexpr int kGzip = 15 + 16, kMemory = 9;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    return {};
  std::string out(text.size(), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));  // zlib only reads it
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const bool whole = deflate(&stream, Z_FINISH) == Z_STREAM_END;
  out.resize(whole ? stream.total_out : 0);
  deflateEnd(&stream);
  return out;
}

}  // namespace

ServedFiles::ServedFiles(std::span<const PageFile> files) {
  for (const PageFile& file : files) {
    const std::string hash = sha256_hex(file.text).substr(0, 32);
    files_.emplace('/' + std::string(file.name),
                   ServedFile{type_of(file.name), file.text, compressed(file.text),
                              '"' + hash + '"', '"' + hash + "-gzip\""});
  }
}

const ServedFile* ServedFiles::find(std::string_view path) const {
  const auto found = files_.find(path == "/" ? std::string_view("/index.html") : path);
  return found == files_.end() ? nullptr : &found->second;
}

}  // namespace mdof::rpc
