#include "daemon/rpc/web/http_head.h"

#include <algorithm>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <charconv>
#include <limits>

namespace mdof::rpc {
namespace {

namespace http = boost::beast::http;
using Fields = http::request<http::empty_body>;

constexpr std::string_view kEnd = "\r\n\r\n";

tl::unexpected<HttpError> refused(int status, std::string text) {
  return tl::unexpected(HttpError{status, std::move(text)});
}

template <class Name>
std::string field(const Fields& fields, Name name) {
  const auto value = fields[name];
  return {value.data(), value.size()};
}

// The fields that determine the destination or the length of a request must not be repeated,
// because a proxy could use the other value.
tl::expected<void, HttpError> check_single(const Fields& fields) {
  for (const auto name : {http::field::host, http::field::content_length, http::field::content_type,
                          http::field::origin, http::field::authorization}) {
    if (fields.count(name) > 1) {
      const auto text = to_string(name);
      return refused(400, "the request has the header field " +
                              std::string(text.data(), text.size()) + " more than once");
    }
  }
  return {};
}

tl::expected<std::size_t, HttpError> body_bytes_of(const Fields& fields, std::size_t most) {
  if (fields.count(http::field::transfer_encoding) > 0)
    return refused(501, "Transfer-Encoding is not supported; send the body with Content-Length");
  if (fields.count(http::field::content_length) == 0) return 0;
  const std::string text = field(fields, http::field::content_length);
  std::uint64_t bytes = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bytes);
  if (text.empty() || end != text.data() + text.size() || error == std::errc::invalid_argument)
    return refused(400, "Content-Length is not a number");
  if (error != std::errc{} || bytes > most)
    return refused(413, "the body is too large (limit " + std::to_string(most) + " bytes)");
  return static_cast<std::size_t>(bytes);
}

// Reads the target of the request. Accepts only "/path?query", no absolute URL and no fragment.
tl::expected<void, HttpError> take_target(std::string_view target, HttpHead& out) {
  if (target.empty() || target.front() != '/' || target.find('#') != target.npos)
    return refused(400, "the target of the request must be a path, such as /index.html");
  const auto query = std::min(target.find('?'), target.size());
  out.path = target.substr(0, query);
  if (query < target.size()) out.query = target.substr(query + 1);
  return {};
}

bool lists_gzip(const std::string& accepted) {
  const auto at = accepted.find("gzip");
  return at != std::string::npos && accepted.compare(at, 7, "gzip;q=") != 0;
}

}  // namespace

tl::expected<std::size_t, HttpError> head_length(std::string_view received, std::size_t& scanned,
                                                 std::size_t max_bytes) {
  if (!received.empty() && (received.front() < 'A' || received.front() > 'Z'))
    return refused(400, "this is not an HTTP request");
  const std::size_t most = std::min(received.size(), max_bytes);
  for (; scanned < most; ++scanned) {
    const char c = received[scanned];
    const char before = scanned > 0 ? received[scanned - 1] : '\0';
    if ((c == '\n') != (before == '\r') || c == '\0')
      return refused(
          400, "each header line must end with CR LF and must not contain another CR, LF or NUL");
    if ((c == ' ' || c == '\t') && before == '\n')
      return refused(400, "a header field must not continue on the next line");
    if (c == '\n' && received.substr(0, scanned + 1).ends_with(kEnd)) return ++scanned;
  }
  if (received.size() >= max_bytes)
    return refused(431, "the header of the request is too large (limit " +
                            std::to_string(max_bytes) + " bytes)");
  return 0;
}

tl::expected<HttpHead, HttpError> read_head(std::string_view head, const HttpLimits& limits) {
  http::request_parser<http::empty_body> parser;
  parser.header_limit(static_cast<std::uint32_t>(limits.head_bytes));
  parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // checked below
  boost::system::error_code error;
  parser.put(boost::asio::const_buffer(head.data(), head.size()), error);
  if (error && error != http::error::need_more)
    return refused(400, "the request cannot be read: " + error.message());
  if (!parser.is_header_done()) return refused(400, "the header of the request is not complete");
  const Fields& fields = parser.get();
  MDOF_CHECK(check_single(fields));
  HttpHead out;
  MDOF_TRY(out.body_bytes, body_bytes_of(fields, limits.body_bytes));
  const auto method = fields.method_string(), target = fields.target();
  out.method.assign(method.data(), method.size());
  MDOF_CHECK(take_target({target.data(), target.size()}, out));
  if (fields.count(http::field::host) == 0) return refused(400, "the header field Host is missing");
  out.host = field(fields, http::field::host);
  out.origin = field(fields, http::field::origin);
  out.fetch_site = field(fields, "Sec-Fetch-Site");
  out.content_type = field(fields, http::field::content_type);
  out.authorization = field(fields, http::field::authorization);
  out.if_none_match = field(fields, http::field::if_none_match);
  out.takes_gzip = lists_gzip(field(fields, http::field::accept_encoding));
  out.keep_alive = parser.keep_alive();
  const auto continues = fields[http::field::expect];
  out.expects_continue = boost::beast::iequals(continues, "100-continue");
  out.last_event_id = field(fields, "Last-Event-ID");
  return out;
}

}  // namespace mdof::rpc
