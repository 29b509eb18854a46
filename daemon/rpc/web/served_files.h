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
  std::string gzip;             // of the text; empty: not shorter
  std::string etag, etag_gzip;  // in quotes; of the content
};

class ServedFiles {
 public:
  // A name without a known type is a bug.
  explicit ServedFiles(std::span<const PageFile> files);
  // "/NAME", or "/" for index.html. Names are compared as they are, without decoding: there is no
  // way out of the list. None: nullptr.
  const ServedFile* find(std::string_view path) const;

 private:
  std::map<std::string, ServedFile, std::less<>> files_;
};

}  // namespace mdof::rpc
