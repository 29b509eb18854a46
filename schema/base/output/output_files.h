// Files for people and controllers: each appears under its name whole, and those of one set all or
// none. On a full disk, or when the program ends early, what was there before stays as it was.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

// replace: a text; what is no text (a database, a recording, a compressed log) is never replaced.
enum class Existing { refuse, replace };

// Written to temporary files in the same folders, then flushed to the disk and renamed. A symbolic
// link is never written through or replaced. Devices and pipes (/dev/null) are written directly.
// A replaced file keeps its permissions. A power cut between the renames of a set can leave some of
// its files new and others old, each of them whole.
class OutputFiles {
 public:
  explicit OutputFiles(Existing existing) : existing_(existing) {}
  ~OutputFiles();  // removes what was not published
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  // Its number in the set. Errors: usage where the file exists and may not be replaced; io.
  Result<std::size_t> add(const std::filesystem::path& path);
  Status write(std::size_t file, std::string_view text);
  Status publish();  // once, after everything was written

 private:
  // direct: a device; exchanged: the old file has the temporary name now; replaced: it is gone.
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

// As a set of one. HTML and XML do not replace what is neither, nor the other way round: usage.
Status write_file(const std::filesystem::path& path, std::string_view text, Existing existing);

}  // namespace mdof
