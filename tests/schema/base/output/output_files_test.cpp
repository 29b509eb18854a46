#include "schema/base/output/output_files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <map>

namespace mdof {
namespace {

namespace fs = std::filesystem;

class Output : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "mdof_output_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  void make(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  // The text of each file in the folder, by name.
  std::map<std::string, std::string> found() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      std::ifstream in(entry.path(), std::ios::binary);
      files[entry.path().filename()] = {std::istreambuf_iterator<char>(in), {}};
    }
    return files;
  }
  using Files = std::map<std::string, std::string>;

  fs::path folder_;
};

TEST_F(Output, AppearsAfterEverythingIsWritten) {
  make("old", "before");
  fs::permissions(folder_ / "old", fs::perms(0640));
  {
    OutputFiles files(Existing::replace);
    const auto old = files.add(folder_ / "old"), made = files.add(folder_ / "made");
    ASSERT_TRUE(old && made);
    ASSERT_TRUE(files.write(*old, "af") && files.write(*made, "new") && files.write(*old, "ter"));
    EXPECT_EQ(found()["old"], "before");
    EXPECT_EQ(found().count("made"), 0u);
    ASSERT_TRUE(files.publish());
  }
  EXPECT_EQ(found(), (Files{{"made", "new"}, {"old", "after"}}));
  EXPECT_EQ(fs::status(folder_ / "old").permissions(), fs::perms(0640));
}

TEST_F(Output, LeavesNoFileIfNotPublished) {
  make("old", "before");
  {
    OutputFiles files(Existing::replace);
    const auto old = files.add(folder_ / "old"), made = files.add(folder_ / "made");
    ASSERT_TRUE(old && made && files.write(*old, "after"));
  }
  EXPECT_EQ(found(), (Files{{"old", "before"}}));
}

TEST_F(Output, RejectsAnExistingFile) {
  make("old", "before");
  const auto refused = write_file(folder_ / "old", "after", Existing::refuse);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  EXPECT_EQ(found()["old"], "before");
  ASSERT_TRUE(write_file(folder_ / "made", "new", Existing::refuse));
  EXPECT_EQ(found()["made"], "new");
}

// Neither write_file() nor OutputFiles may replace these files.
TEST_F(Output, DoesNotReplaceDatabasesLogsAndRecordings) {
  using namespace std::string_literals;
  const Files valuable = {{"database", "SQLite format 3\0 and pages"s},
                          {"write-ahead log", "\x37\x7f\x06\x82\0\x2d\xe2\x18"s},
                          {"log.gz", "\x1f\x8b\x08\0\0"s},
                          {"chain.head", "{\"entries\": 12}\n"},
                          {"log.csv", "time_s,encoder_mm\n0,1\n"}};
  for (const auto& [name, text] : valuable) {
    make(name, text);
    const Status written = write_file(folder_ / name, "<html>", Existing::replace);
    ASSERT_FALSE(written) << name;
    EXPECT_EQ(written.error().code, ErrorCode::usage);
    EXPECT_NE(written.error().message.find(folder_ / name), std::string::npos);
  }
  OutputFiles files(Existing::replace);
  EXPECT_FALSE(files.add(folder_ / "database"));
  EXPECT_EQ(found(), valuable);
  make("report", "\n<html>");
  EXPECT_FALSE(write_file(folder_ / "report", "a,b\n", Existing::replace));
  EXPECT_TRUE(write_file(folder_ / "report", "<!DOCTYPE html>\ttab\r\n", Existing::replace));
  EXPECT_TRUE(write_file(folder_ / "log.csv", "\xc2\xb5m,b\n", Existing::replace));
}

TEST_F(Output, DoesNotReplaceAFileCreatedMeanwhile) {
  OutputFiles files(Existing::refuse);
  ASSERT_TRUE(files.add(folder_ / "a") && files.add(folder_ / "b"));
  make("b", "somebody's");
  const auto refused = files.publish();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("b: cannot be written: File exists"), std::string::npos)
      << refused.error().message;
  EXPECT_EQ(found()["b"], "somebody's");
  EXPECT_EQ(found().count("a"), 0u);
}

TEST_F(Output, ReplacesAllFilesOrNone) {
  make("a", "old a");
  make("b", "old b");
  {
    OutputFiles files(Existing::replace);
    const auto a = files.add(folder_ / "a"), b = files.add(folder_ / "b");
    ASSERT_TRUE(a && b && files.write(*a, "new a") && files.write(*b, "new b"));
    fs::remove(folder_ / "b");  // another program removes the file
    ASSERT_FALSE(files.publish());
  }
  EXPECT_EQ(found(), (Files{{"a", "old a"}}));
}

TEST_F(Output, DoesNotFollowSymbolicLinks) {
  make("target", "before");
  fs::create_symlink("target", folder_ / "link");
  fs::create_symlink("nowhere", folder_ / "dangling");
  for (const char* const link : {"link", "dangling"})
    for (const Existing existing : {Existing::refuse, Existing::replace}) {
      EXPECT_FALSE(write_file(folder_ / link, "after", existing)) << link;
      EXPECT_TRUE(fs::is_symlink(folder_ / link));
    }
  EXPECT_EQ(found()["target"], "before");
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(Output, WritesDirectlyToADevice) {
  EXPECT_TRUE(write_file("/dev/null", "text", Existing::replace));
  const auto full = write_file("/dev/full", "text", Existing::replace);
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().code, ErrorCode::io);
  EXPECT_NE(full.error().message.find("/dev/full: cannot be written: No space left"),
            std::string::npos);
}

TEST_F(Output, ChangesNothingWithoutSpace) {
  make("old", "before");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto refused = write_file(folder_ / "old", std::string(2000, 'x'), Existing::replace);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::io);
  EXPECT_EQ(found(), (Files{{"old", "before"}}));
}

TEST_F(Output, ReportsAMissingFolder) {
  const auto refused = write_file(folder_ / "no" / "file", "text", Existing::replace);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("no/file: cannot be written: No such file"),
            std::string::npos);
}

}  // namespace
}  // namespace mdof
