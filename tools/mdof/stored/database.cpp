#include "tools/mdof/stored/database.h"

#include "daemon/paths.h"
#include "daemon/store/file/writer_lock.h"

namespace mdof::tools {

Result<std::filesystem::path> database_path(const std::string& option) {
  return option.empty() ? daemon::default_database() : std::filesystem::path(option);
}

Result<store::Store> open_to_read(const std::string& option) {
  MDOF_TRY(const auto file, database_path(option));
  return store::Store::open(file, store::Access::read_only);
}

Result<store::Store> open_to_write(const std::string& option) {
  MDOF_TRY(const auto file, database_path(option));
  return store::Store::open(file, store::Access::read_write);
}

Result<bool> somebody_writes(const std::string& option) {
  MDOF_TRY(const auto file, database_path(option));
  return store::WriterLock::held(file);
}

}  // namespace mdof::tools
