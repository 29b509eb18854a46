// Writes files for people and controllers. Each file appears under its name only when complete, and
// the files of a set appear all or none. On a full disk, or if the program ends early, the previous
// files remain unchanged.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

// replace: text files only; a database, a recording or a compressed log is never replaced.
enum class Existing { refuse, replace };

// The files are written as temporary files in the same folders, then flushed to the disk and
// renamed. Symbolic links are neither followed nor replaced. Devices and pipes (/dev/null) are
// written directly. A replaced file keeps its permissions. A power cut between the renames of a set
// can leave some of its files new and others old, each of them complete.
class OutputFiles {
 public:
  explicit OutputFiles(Existing existing) : existing_(existing) {}
  ~OutputFiles();  // removes unpublished files
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  // Returns the number of the file in the set. Errors: usage if the file exists and must not be
  // replaced; io.
  Result<std::size_t> add(const std::filesystem::path& path);
  Status write(std::size_t file, std::string_view text);
  Status publish();  // once, after everything was written

 private:
  // direct: a device; exchanged: the old file has the temporary name now; replaced: the old file is
  // deleted.
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

// Writes a set of one file. Markup (HTML, XML) replaces only markup, other text only other text.
// Error: usage.
Status write_file(const std::filesystem::path& path, std::string_view text, Existing existing);

}  // namespace mdof
