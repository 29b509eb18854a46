// The files of the web page as they are sent. Private header.
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
  std::string gzip;             // compressed text; empty: not shorter
  std::string etag, etag_gzip;  // hash of the content, in quotes
};

class ServedFiles {
 public:
  // A name without a known type is a programming error.
  explicit ServedFiles(std::span<const PageFile> files);
  // "/NAME", or "/" for index.html. Names are compared without decoding, so that only listed files
  // can be read. nullptr if unknown.
  const ServedFile* find(std::string_view path) const;

 private:
  std::map<std::string, ServedFile, std::less<>> files_;
};

}  // namespace mdof::rpc
