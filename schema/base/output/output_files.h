// Writes files for people and controllers. A file gets its name only when it is complete. Either
// all files of a set get their names, or none. If the disk is full or the program ends early, the
// previous files are unchanged.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

// replace: for text files only; a database, a recording or a compressed log is never replaced.
enum class Existing { refuse, replace };

// The files are written as temporary files in the same folders, flushed to the disk and then
// renamed. Symbolic links are neither followed nor replaced. Devices and pipes (/dev/null) are
// written directly. A replaced file keeps its permissions. If the power fails while the files of a
// set are renamed, some of the files may be new and others old; each of these files is complete.
class OutputFiles {
 public:
  explicit OutputFiles(Existing existing) : existing_(existing) {}
  ~OutputFiles();  // removes the files that were not published
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  // Returns the index of the file in the set. Errors: usage (the file exists and must not be
  // replaced); io.
  Result<std::size_t> add(const std::filesystem::path& path);
  Status write(std::size_t file, std::string_view text);
  Status publish();  // call it once, after all files were written

 private:
  // direct: a device or pipe; exchanged: the old file has the temporary name now; replaced: the old
  // file was deleted.
  enum class Stage { direct, written, created, exchanged, replaced };
  struct File {
    std::filesystem::path path, temporary;
    int descriptor = -1;
    bool replaces = false;
    Stage stage = Stage::written;
  };
  Status rename(File& file);
  Error undone(Error error);

  Existing existing_;
  std::vector<File> files_;
};

// Writes a set that contains one file. Markup (HTML, XML) may replace only markup, and other text
// only other text. Error: usage.
Status write_file(const std::filesystem::path& path, std::string_view text, Existing existing);

}  // namespace mdof
