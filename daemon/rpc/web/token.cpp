#include "daemon/rpc/web/token.h"

#include <fcntl.h>
#include <openssl/crypto.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "daemon/rpc/net/socket.h"

namespace mdof::rpc {
namespace {

constexpr std::size_t kBytes = 32;

tl::unexpected<Error> cannot_use(const std::filesystem::path& file, const std::string& what,
                                 int number) {
  return io_error(file.string() + ": " + what + ": " + system_error_text(number));
}

Result<std::string> new_token() {
  std::array<unsigned char, kBytes> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    return io_error("the kernel returned no random numbers: " + system_error_text(errno));
  std::string text;
  for (const unsigned char byte : bytes)
    for (const int digit : {byte >> 4, byte & 15}) text += "0123456789abcdef"[digit];
  return text;
}

Result<std::string> make_token(const std::filesystem::path& file) {
  MDOF_TRY(const std::string token, new_token());
  std::error_code failed;  // open() reports a folder that cannot be created
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), failed);
  const Descriptor fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (fd.get() < 0) return cannot_use(file, "mdofd cannot create this file", errno);
  const std::string line = token + "\n";
  if (::write(fd.get(), line.data(), line.size()) != static_cast<ssize_t>(line.size()) ||
      ::fsync(fd.get()) != 0) {
    const int number = errno;
    (void)::unlink(file.c_str());
    return cannot_use(file, "mdofd cannot write to this file", number);
  }
  return token;
}

}  // namespace

Result<std::string> read_token(const std::filesystem::path& file) {
  const Descriptor fd(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW));
  if (fd.get() < 0) return cannot_use(file, "mdofd cannot read this file", errno);
  struct stat info {};
  if (::fstat(fd.get(), &info) != 0) return cannot_use(file, "mdofd cannot read this file", errno);
  if (!S_ISREG(info.st_mode))
    return fail(ErrorCode::check, file.string() +
                                      ": this is not a regular file; remove this file and restart "
                                      "mdofd; mdofd then creates a new token file");
  if ((info.st_mode & 077) != 0)
    return fail(ErrorCode::check, file.string() +
                                      ": other users can read this file; remove this file and "
                                      "restart mdofd; mdofd then creates a new token file (mode "
                                      "0600)");
  std::array<char, 2 * kBytes + 2> bytes{};
  const ssize_t got = ::read(fd.get(), bytes.data(), bytes.size());
  std::string_view text(bytes.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  if (text.ends_with('\n')) text.remove_suffix(1);
  if (text.size() != 2 * kBytes ||
      text.find_first_not_of("0123456789abcdef") != std::string_view::npos)
    return fail(ErrorCode::check, file.string() +
                                      ": this file does not contain 64 hexadecimal digits; remove "
                                      "this file and restart mdofd; mdofd then creates a new token "
                                      "file");
  return std::string(text);
}

Result<std::string> load_token(const std::filesystem::path& file) {
  struct stat info {};
  if (::lstat(file.c_str(), &info) != 0 && errno == ENOENT) return make_token(file);
  return read_token(file);
}

bool bears_token(std::string_view authorization, std::string_view token) {
  constexpr std::string_view kScheme = "Bearer ";
  if (token.empty() || !authorization.starts_with(kScheme)) return false;
  authorization.remove_prefix(kScheme.size());
  return authorization.size() == token.size() &&
         CRYPTO_memcmp(authorization.data(), token.data(), token.size()) == 0;
}

}  // namespace mdof::rpc
