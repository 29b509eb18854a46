// The files of the web page, ready to be sent. Private header.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "daemon/rpc/web/page_files.h"

namespace mdof::rpc {

struct ServedFile {
  std::string_view type;  // "text/css; charset=utf-8"
  std::string_view text;
  std::string gzip;             // compressed text; empty if it would not be shorter
  std::string etag, etag_gzip;  // hash of the content, in quotes
};

class ServedFiles {
 public:
  // It is a programming error if the type of a name is unknown.
  explicit ServedFiles(std::span<const PageFile> files);
  // `path` is "/NAME", or "/" for index.html. The path is not decoded, and only the files of the
  // page can be found. nullptr: no such file.
  const ServedFile* find(std::string_view path) const;

 private:
  std::map<std::string, ServedFile, std::less<>> files_;
};

}  // namespace mdof::rpc
