#include "daemon/rpc/web/http_head.h"

#include <gtest/gtest.h>

namespace mdof::rpc {
namespace {

constexpr HttpLimits kLimits{8192, 65536};

// The status with which the server rejects the head of `text`; 200 if it accepts the head; 0 if
// the head is incomplete.
int head_status(const std::string& text, HttpHead* head = nullptr) {
  std::size_t scanned = 0;
  const auto end = head_length(text, scanned, kLimits.head_bytes);
  if (!end) return end.error().status;
  if (*end == 0) return 0;
  auto read = read_head(std::string_view(text).substr(0, *end), kLimits);
  if (!read) return read.error().status;
  if (head) *head = *read;
  return 200;
}

std::string with_fields(const std::string& fields) {
  return "POST /rpc HTTP/1.1\r\nHost: localhost:1\r\n" + fields + "\r\n";
}

TEST(HttpHead, IsReadWithAllFieldsThatMdofdNeeds) {
  HttpHead head;
  ASSERT_EQ(head_status("GET /events?topics=a%2Cb&interval_ms=20 HTTP/1.1\r\n"
                        "host: localhost:8080\r\nOrigin: http://localhost:8080\r\n"
                        "Accept-Encoding: br, gzip\r\nlast-event-id:  17 \r\n"
                        "Sec-Fetch-Site: same-origin\r\nIf-None-Match: \"x\"\r\n"
                        "Authorization: Bearer t\r\n\r\n",
                        &head),
            200);
  EXPECT_EQ(head.method, "GET");
  EXPECT_EQ(head.path, "/events");
  EXPECT_EQ(head.query, "topics=a%2Cb&interval_ms=20");
  EXPECT_EQ(head.host, "localhost:8080");
  EXPECT_EQ(head.origin, "http://localhost:8080");
  EXPECT_EQ(head.last_event_id, "17");
  EXPECT_EQ(head.fetch_site, "same-origin");
  EXPECT_EQ(head.if_none_match, "\"x\"");
  EXPECT_EQ(head.authorization, "Bearer t");
  EXPECT_TRUE(head.takes_gzip);
  EXPECT_TRUE(head.keep_alive);
  EXPECT_EQ(head.body_bytes, 0U);
}

TEST(HttpHead, StatesWhetherTheConnectionIsKept) {
  HttpHead head;
  ASSERT_EQ(head_status("GET / HTTP/1.0\r\nHost: localhost\r\n\r\n", &head), 200);
  EXPECT_FALSE(head.keep_alive);
  ASSERT_EQ(head_status(with_fields("Connection: close\r\n"), &head), 200);
  EXPECT_FALSE(head.keep_alive);
  ASSERT_EQ(head_status(with_fields("Content-Length: 5\r\nExpect: 100-continue\r\n"), &head), 200);
  EXPECT_TRUE(head.expects_continue);
  EXPECT_EQ(head.body_bytes, 5U);
  ASSERT_EQ(head_status(with_fields("Accept-Encoding: gzip;q=0\r\n"), &head), 200);
  EXPECT_FALSE(head.takes_gzip);
}

// If two programs could interpret the bytes differently, the head is rejected (RFC 9112, 11.2).
TEST(HttpHead, RejectsAmbiguousHeads) {
  EXPECT_EQ(head_status(with_fields("Content-Length: 5\r\n")), 200);
  EXPECT_EQ(head_status(with_fields("Content-Length: 5\r\nContent-Length: 6\r\n")), 400);
  EXPECT_EQ(head_status(with_fields("Content-Length: 5\r\nContent-Length: 5\r\n")), 400);
  for (const char* length : {"5, 5", "+5", "-1", "0x5", "5 5", "", "5;", "٥"})
    EXPECT_EQ(head_status(with_fields("Content-Length: " + std::string(length) + "\r\n")), 400)
        << length;
  EXPECT_NE(head_status(with_fields("Content-Length: 5\r\nTransfer-Encoding: chunked\r\n")), 200);
  EXPECT_NE(head_status(with_fields("Transfer-Encoding: chunked\r\nContent-Length: 5\r\n")), 200);
  for (const char* coding :
       {"chunked", "identity", "xchunked", "chunked, chunked", "gzip, chunked"})
    EXPECT_EQ(head_status(with_fields("Transfer-Encoding: " + std::string(coding) + "\r\n")), 501)
        << coding;
  EXPECT_EQ(head_status(with_fields("Transfer-Encoding : chunked\r\n")), 400);
  EXPECT_EQ(head_status(with_fields("X: a\r\n b\r\n")), 400);
  EXPECT_EQ(head_status(with_fields("X: a\r\n\tb\r\n")), 400);
  EXPECT_EQ(head_status("POST /rpc HTTP/1.1\r\n Host: a\r\n\r\n"), 400);
  EXPECT_EQ(head_status("POST /rpc HTTP/1.1\nHost: localhost\n\n"), 400);
  EXPECT_EQ(head_status(with_fields("X: a\nContent-Length: 5\r\n")), 400);
  EXPECT_EQ(head_status(with_fields("X: a\rContent-Length: 5\r\n")), 400);
  EXPECT_EQ(head_status(with_fields(std::string("X: a\0b\r\n", 8))), 400);
  EXPECT_EQ(head_status(with_fields("Host: localhost:1\r\n")), 400);
  EXPECT_EQ(head_status(with_fields("no colon\r\n")), 400);
}

TEST(HttpHead, NeedsAPathAHostAndAVersion) {
  for (const char* target : {"http://localhost/", "*", "index.html", "/a#b", "localhost:80"})
    EXPECT_EQ(head_status("GET " + std::string(target) + " HTTP/1.1\r\nHost: a\r\n\r\n"), 400)
        << target;
  EXPECT_EQ(head_status("GET / HTTP/1.1\r\n\r\n"), 400);
  for (const char* version : {"HTTP/2.0", "HTTP/1.2", "HTTP/1.11", "http/1.1", "HTTP/0.9", ""})
    EXPECT_EQ(head_status("GET / " + std::string(version) + "\r\nHost: a\r\n\r\n"), 400) << version;
  EXPECT_EQ(head_status("GET /\r\n\r\n"), 400);
  EXPECT_EQ(head_status("\x16\x03\x01"), 400);  // the start of a TLS connection
  EXPECT_EQ(head_status("{\"jsonrpc\""), 400);
}

TEST(HttpHead, HasLimits) {
  EXPECT_EQ(head_status(with_fields("X: " + std::string(9000, 'x') + "\r\n")), 431);
  EXPECT_EQ(head_status("GET /" + std::string(9000, 'x')), 431);
  std::string many;
  for (int i = 0; i < 3000; ++i) many += "A:\r\n";
  EXPECT_EQ(head_status(with_fields(many)), 431);
  EXPECT_EQ(head_status(with_fields("Content-Length: 65536\r\n")), 200);
  EXPECT_EQ(head_status(with_fields("Content-Length: 65537\r\n")), 413);
  EXPECT_NE(head_status(with_fields("Content-Length: 18446744073709551621\r\n")), 200);
}

TEST(HttpHead, EndIsFoundForAnyDivisionOfTheBytes) {
  const std::string text = with_fields("Content-Length: 2\r\n") + "{}";
  std::size_t scanned = 0;
  for (std::size_t n = 1; n < text.size() - 2; ++n)
    EXPECT_EQ(*head_length(text.substr(0, n), scanned, 8192), 0U) << n;
  EXPECT_EQ(*head_length(text, scanned, 8192), text.size() - 2);
}

}  // namespace
}  // namespace mdof::rpc
