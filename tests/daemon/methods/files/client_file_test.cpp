#include "daemon/methods/files/client_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "daemon/measure/replay/replay.h"

namespace mdof::daemon {
namespace {

namespace fs = std::filesystem;

class ClientFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "mdof-client-file-XXXXXX").string();
    ASSERT_TRUE(::mkdtemp(name.data()));
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const char* name, const std::string& text) {
    const fs::path file = folder_ / name;
    std::ofstream(file) << text;
    return file.string();
  }
  static std::string refusal(const std::string& path, const FileUser& user = {::getuid(), 0}) {
    const auto opened = open_for(user, path);
    return opened ? "" : opened.error().message;
  }

  fs::path folder_;
};

std::string text_of(const ClientFile& opened) {
  std::string text(1000, '\0');
  const ssize_t got = ::pread(opened.file.get(), text.data(), text.size(), 0);
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return text;
}

TEST_F(ClientFiles, ReadsTheOpenedFileAfterItsNameWasReused) {
  const std::string path =
      write("log.csv", "time_s,encoder_mm,A_um,B_um,C_um,D_um,E_um\n0,0,1,2,3,4,5\n");
  const auto opened = open_for({::getuid(), 0}, path);
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  fs::remove(path);
  fs::create_symlink("/etc/shadow", path);
  auto log = ReplayLog::open(path, {opened->file.get(), -1});
  ASSERT_TRUE(log.has_value()) << log.error().message;
  SampleBlock block;
  ASSERT_TRUE(log->driver().read(block, std::chrono::milliseconds(1000)));
  ASSERT_EQ(block.scans(), 1u);
  EXPECT_EQ(block.value.back().front(), 5);
}

TEST_F(ClientFiles, RejectsALink) {
  const std::string path = (folder_ / "link.csv").string();
  fs::create_symlink(write("log.csv", "1\n"), path);
  EXPECT_NE(refusal(path).find("is a link"), std::string::npos) << refusal(path);
}

// If nobody writes to a pipe, opening the pipe for reading never returns.
TEST_F(ClientFiles, RejectsAPipeAtOnce) {
  const std::string path = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0666), 0);
  EXPECT_NE(refusal(path).find("is not a regular file"), std::string::npos) << refusal(path);
}

TEST_F(ClientFiles, DoesNotWaitForAFileWithALease) {
  const std::string path = write("log.csv", "1\n");
  const int holder = ::open(path.c_str(), O_RDONLY);
  if (::fcntl(holder, F_SETLEASE, F_WRLCK) != 0) GTEST_SKIP() << "no leases on this file system";
  ::signal(SIGIO, SIG_IGN);
  EXPECT_NE(refusal(path).find("Resource temporarily unavailable"), std::string::npos)
      << refusal(path);
  ::close(holder);
  EXPECT_EQ(refusal(path), "");
}

TEST_F(ClientFiles, UsesAllGroupsOfTheUser) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root gives a file to others";
  const std::string path = write("log.csv", "1\n");
  ASSERT_EQ(::chown(path.c_str(), 2001, 3001), 0);
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  EXPECT_EQ(refusal(path, {2002, 3002, {5, 3001}}), "");
  EXPECT_NE(refusal(path, {2002, 3002, {5}}).find("you have no permission to read"),
            std::string::npos);
  ASSERT_EQ(::chmod(path.c_str(), 0604), 0);
  EXPECT_NE(refusal(path, {2002, 3002, {5, 3001}}).find("you have no permission"),
            std::string::npos)
      << "a member of the group without the right";
}

TEST_F(ClientFiles, AppliesTheSameRulesToTheWalOfARecording) {
  const std::string path = write("run.mdofrec", "1\n");
  EXPECT_EQ(open_for({::getuid(), 0}, path)->wal.get(), -1);
  fs::create_symlink("/etc/shadow", path + "-wal");
  EXPECT_NE(refusal(path).find("-wal: this path is a link"), std::string::npos) << refusal(path);
  fs::remove(path + "-wal");
  write("run.mdofrec-wal", "2\n");
  const auto opened = open_for({::getuid(), 0}, path);
  ASSERT_TRUE(opened.has_value());
  EXPECT_GE(opened->wal.get(), 0);
  EXPECT_EQ(text_of(*opened), "1\n");
}

}  // namespace
}  // namespace mdof::daemon
