#include "tools/mdof/stored/database.h"

#include "daemon/paths.h"
#include "daemon/store/file/writer_lock.h"
#include "daemon/words/shell_word.h"

namespace mdof::tools {

Result<std::filesystem::path> database_path(const std::string& option) {
  return option.empty() ? daemon::default_database() : std::filesystem::path(option);
}

namespace {

// The path of the database. Error: the path is a FIFO, for which mdof would wait, or a folder. For
// a folder, the message of SQLite would describe a fault of the disk.
Result<std::filesystem::path> database_file(const std::string& option) {
  MDOF_TRY(auto file, database_path(option));
  std::error_code ec;
  if (std::filesystem::exists(file, ec) && !std::filesystem::is_regular_file(file, ec))
    return bad_input(file.string() + ": this is a " +
                     (std::filesystem::is_directory(file, ec) ? "folder" : "pipe or device") +
                     ", not a database; give the name of a database file");
  return file;
}

}  // namespace

Result<store::Store> open_to_read(const std::string& option) {
  MDOF_TRY(const auto file, database_file(option));
  return store::Store::open(file, store::Access::read_only);
}

Result<store::Store> open_to_write(const std::string& option) {
  MDOF_TRY(const auto file, database_file(option));
  auto store = store::Store::open(file, store::Access::read_write);
  if (!store && store.error().code == ErrorCode::conflict) store.error().code = ErrorCode::io;
  return store;
}

Result<store::Store> open_existing_to_write(const std::string& option) {
  MDOF_TRY(const auto file, database_file(option));
  std::error_code ec;
  return std::filesystem::exists(file, ec) ? open_to_write(option) : open_to_read(option);
}

std::string place_options(const std::string& database, const std::string& socket) {
  std::string options;
  if (!database.empty()) options = " --db " + words::shell_word(database);
  if (!socket.empty() && socket != daemon::default_socket())
    options += " --socket " + words::shell_word(socket);
  return options;
}

Result<bool> is_locked_by_writer(const std::string& option) {
  MDOF_TRY(const auto file, database_file(option));
  return store::WriterLock::held(file);
}

}  // namespace mdof::tools
