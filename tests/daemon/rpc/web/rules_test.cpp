// Rules that need no connection: allowed hosts and origins, the file of the token, kept events,
// queries.
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "daemon/rpc/web/events/event_query.h"
#include "daemon/rpc/web/events/kept_events.h"
#include "daemon/rpc/web/same_site.h"
#include "daemon/rpc/web/served_files.h"
#include "daemon/rpc/web/token.h"
#include "tests/daemon/rpc/web/http_fixture.h"

namespace mdof::rpc::test {
namespace {

int judged(const std::string& host, const std::string& origin = "", const std::string& site = "",
           const std::string& path = "/rpc") {
  HttpHead head;
  head.host = host;
  head.origin = origin;
  head.fetch_site = site;
  head.path = path;
  const auto same = check_same_site(head, {"Mill.local:8080"});
  return same ? 200 : same.error().status;
}

// DNS rebinding: a foreign host name has the address of this machine. All requests of the foreign
// page then have this name as host.
TEST(SameSite, AcceptsOnlyItsOwnHosts) {
  for (const char* host : {"localhost:8080", "LOCALHOST", "127.0.0.1:1", "[::1]:8080", "[::1]",
                           "mill.local:8080", "MILL.local:8080"})
    EXPECT_EQ(judged(host), 200) << host;
  for (const char* host :
       {"evil.example", "localhost.evil.example:8080", "evil.example:8080", "mill.local",
        "mill.local:8081", "127.0.0.2:8080", "localhost:", "localhost:80x", "localhost:8080:80",
        "localhost@evil.example", "[::1", "", " ", "localhost:123456", "0.0.0.0:8080"})
    EXPECT_EQ(judged(host), 421) << host;
}

TEST(SameSite, AcceptsOnlyItsOwnPage) {
  EXPECT_EQ(judged("localhost:8080", "http://localhost:8080"), 200);
  // The page is served by a proxy.
  EXPECT_EQ(judged("mill.local:8080", "https://mill.local:8080"), 200);
  for (const char* origin :
       {"http://evil.example", "null", "http://localhost:3000", "http://127.0.0.1:8080",
        "http://localhost", "localhost:8080", "http://localhost:8080.evil.example", "file://"})
    EXPECT_EQ(judged("localhost:8080", origin), 403) << origin;
  EXPECT_EQ(judged("localhost:8080", "", "cross-site"), 403);
  EXPECT_EQ(judged("localhost:8080", "", "same-site", "/events"), 403);
  EXPECT_EQ(judged("localhost:8080", "", "same-origin"), 200);
  // A link on a foreign page to this page.
  EXPECT_EQ(judged("localhost:8080", "", "cross-site", "/"), 200);
}

class TokenFile : public ::testing::Test {
 protected:
  ~TokenFile() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& text, mode_t mode) const {
    std::filesystem::remove(file_);
    std::ofstream(file_) << text;
    ::chmod(file_.c_str(), mode);
  }
  std::filesystem::path folder_ = [] {
    std::string name = std::filesystem::temp_directory_path() / "mdof-token-XXXXXX";
    return std::filesystem::path(::mkdtemp(name.data()));
  }();
  std::filesystem::path file_ = folder_ / "http.token";
};

TEST_F(TokenFile, IsCreatedOnceAndReadableByItsUserOnly) {
  const auto token = load_token(file_);
  ASSERT_TRUE(token.has_value()) << token.error().message;
  EXPECT_EQ(token->size(), 64U);
  struct stat info {};
  ASSERT_EQ(::stat(file_.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 07777, 0600U);
  EXPECT_EQ(load_token(file_).value_or(""), *token);
  std::filesystem::remove(file_);
  EXPECT_NE(load_token(file_).value_or(""), *token);
  std::filesystem::remove(file_);
  EXPECT_FALSE(read_token(file_).has_value());
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(TokenFile, IsCreatedTogetherWithItsFolder) {
  const auto deep = folder_ / "not" / "there" / "http.token";
  const auto token = load_token(deep);
  ASSERT_TRUE(token.has_value()) << token.error().message;
  EXPECT_EQ(read_token(deep).value_or(""), *token);
  const auto impossible = load_token("/proc/none/http.token");
  ASSERT_FALSE(impossible.has_value());
  EXPECT_TRUE(impossible.error().message.starts_with("/proc/none/http.token: "))
      << impossible.error().message;
}

TEST_F(TokenFile, IsRejectedIfMalformedOrReadableByOthers) {
  const std::string good(64, 'b');
  write(good + "\n", 0600);
  EXPECT_EQ(load_token(file_).value_or(""), good);
  for (const mode_t mode : {0640, 0604, 0660, 0644}) {
    write(good + "\n", mode);
    EXPECT_FALSE(load_token(file_).has_value()) << mode;
  }
  for (const std::string& text : {std::string(), good.substr(1), good + "b", "g" + good.substr(1),
                                  good + "\n\n", std::string(64, 'B')}) {
    write(text, 0600);
    EXPECT_FALSE(load_token(file_).has_value()) << text;
  }
  std::filesystem::remove(file_);
  std::filesystem::create_symlink("/etc/hostname", file_);
  EXPECT_FALSE(load_token(file_).has_value());
}

TEST(Token, MustMatchCompletely) {
  EXPECT_TRUE(bears_token("Bearer " + kTestToken, kTestToken));
  for (const std::string& wrong :
       {std::string(), kTestToken, "bearer" + kTestToken, "Bearer " + kTestToken + "a",
        "Bearer " + kTestToken.substr(1), "Bearer b" + kTestToken.substr(1),
        "Bearer  " + kTestToken, std::string("Bearer "), "Basic " + kTestToken})
    EXPECT_FALSE(bears_token(wrong, kTestToken)) << wrong;
  EXPECT_FALSE(bears_token("Bearer ", ""));  // if the token is empty, nobody has permission
}

constexpr std::chrono::system_clock::time_point kStart{std::chrono::seconds(1'790'000'000)};

TEST(KeptEvents, AreNumberedFromTheStart) {
  KeptEvents kept(kStart, {10, 1000});
  EXPECT_EQ(kept.last_id(), 1'790'000'000'000'000U);
  kept.add("a", "1\n2");
  EXPECT_EQ(kept.last_id(), 1'790'000'000'000'001U);
  EXPECT_LT(kept.last_id(), std::uint64_t{1} << 53);
  const auto next = kept.next(kept.last_id() - 1);
  ASSERT_NE(next.event, nullptr);
  EXPECT_EQ(next.event->json, "1 2");
  EXPECT_EQ(kept.next(kept.last_id()).event, nullptr);
}

TEST(KeptEvents, ResumeAfterTheLastEventAndReportLostOnes) {
  KeptEvents kept(kStart, {3, 1000});
  const std::uint64_t base = kept.last_id();
  for (int i = 1; i <= 5; ++i) kept.add("a", std::to_string(i));
  EXPECT_EQ(kept.resume("").after, base + 5);  // a new client receives only later events
  EXPECT_FALSE(kept.resume("").lost);
  const auto near = kept.resume(std::to_string(base + 3));
  EXPECT_FALSE(near.lost);
  EXPECT_EQ(kept.next(near.after).event->json, "4");
  // Event 2 is lost; events 3 to 5 are kept.
  const auto far = kept.resume(std::to_string(base + 1));
  EXPECT_TRUE(far.lost);
  EXPECT_EQ(far.count, 1U);
  EXPECT_EQ(kept.next(far.after).event->json, "3");
  for (const std::string& other :
       {std::to_string(base - 1), std::to_string(base + 6), std::string("x"),
        std::to_string(base) + "x", std::string("-1")}) {
    EXPECT_TRUE(kept.resume(other).lost) << other;
    EXPECT_FALSE(kept.resume(other).count.has_value()) << other;
    EXPECT_EQ(kept.resume(other).after, base + 5) << other;
  }
}

TEST(KeptEvents, UseBoundedMemory) {
  KeptEvents kept(kStart, {1000, 100});
  for (int i = 0; i < 50; ++i) kept.add("topic", std::string(20, 'x'));
  EXPECT_EQ(kept.size(), 4U);
  kept.add("topic", std::string(500, 'x'));  // larger than the memory limit
  EXPECT_EQ(kept.size(), 1U);
}

TEST(EventQuery, IsReadPercentEncodedOrNot) {
  for (const char* query : {"topics=live.update,run.event&interval_ms=20",
                            "interval_ms=20&topics=live.update%2Crun.event",
                            "topics=live%2eupdate,run.event,&interval_ms=%320"}) {
    const auto read = read_event_query(query);
    ASSERT_TRUE(read.has_value()) << query;
    EXPECT_EQ(read->topics, (std::vector<std::string>{"live.update", "run.event"})) << query;
    EXPECT_EQ(read->interval, 20ms);
  }
  EXPECT_EQ(read_event_query("topics=a")->interval, 100ms);
  for (const std::string& query :
       {std::string(), std::string("topics="), std::string("topics=%"), std::string("topics=%2"),
        std::string("topics=%zz"), std::string("topics=a&interval_ms=0"),
        std::string("topics=a&interval_ms=x"), std::string("topics=a&interval_ms=99999999"),
        std::string("topics=a&token=x"), "topics=" + std::string(99, ',') + std::string("a,") + [] {
          std::string many;
          for (int i = 0; i < 40; ++i) many += "a,";
          return many;
        }()}) {
    const auto read = read_event_query(query);
    ASSERT_FALSE(read.has_value()) << query;
    EXPECT_EQ(read.error().status, 400) << query;
  }
}

TEST(ServedFiles, HaveATypeAndAnEtagOfTheirContent) {
  const ServedFiles files(kTestPage);
  ASSERT_NE(files.find("/"), nullptr);
  EXPECT_EQ(files.find("/"), files.find("/index.html"));
  const ServedFile& script = *files.find("/app.js");
  EXPECT_EQ(script.type, "text/javascript; charset=utf-8");
  EXPECT_LT(script.gzip.size(), script.text.size());
  EXPECT_NE(script.etag, script.etag_gzip);
  for (const char* path : {"", "//", "/app.j", "/app.js/", "/../app.js", "/%61pp.js", "/./app.js",
                           "/etc/passwd", "app.js"})
    EXPECT_EQ(files.find(path), nullptr) << path;
}

// The files of the page that this build contains.
TEST(ServedFiles, ContainTheFilesOfThisBuild) {
  const ServedFiles files(page_files());
  ASSERT_NE(files.find("/"), nullptr);
  std::ifstream installed("/usr/share/javascript/dygraphs/dygraph.min.js");
  const std::string text{std::istreambuf_iterator<char>(installed), {}};
  ASSERT_NE(files.find("/dygraph.min.js"), nullptr);
  EXPECT_EQ(files.find("/dygraph.min.js")->text, text);
  std::size_t sent = 0;
  for (const PageFile& file : page_files()) {
    const ServedFile& served = *files.find('/' + std::string(file.name));
    sent += served.gzip.empty() ? served.text.size() : served.gzip.size();
  }
  EXPECT_LT(sent, 200'000U);  // size of all files of the page, as a browser receives them
}

}  // namespace
}  // namespace mdof::rpc::test
