// Requests of browsers and the server's answers: the page, calls of methods, streams of events.
#include "tests/daemon/rpc/web/http_fixture.h"

namespace mdof::rpc::test {
namespace {

const std::string kOurs = "Authorization: Bearer " + kTestToken + "\r\n";

TEST_F(WebPage, ServesItsFilesWithSecurityFields) {
  const Answer page = ask(get("/"));
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, kTestPage[0].text);
  EXPECT_EQ(page.field("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(page.field("Cache-Control"), "no-cache");
  for (const Answer& any : {page, ask(get("/none")), ask(post("{}"))}) {
    EXPECT_EQ(any.field("Content-Security-Policy").find("default-src 'self'"), 0U);
    EXPECT_NE(any.field("Content-Security-Policy").find("frame-ancestors 'none'"),
              std::string::npos);
    EXPECT_EQ(any.field("Content-Security-Policy").find("unsafe"), std::string::npos);
    EXPECT_EQ(any.field("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(any.field("Referrer-Policy"), "no-referrer");
    EXPECT_EQ(any.field("Cross-Origin-Resource-Policy"), "same-origin");
    EXPECT_EQ(any.field("Access-Control-Allow-Origin"), "");
  }
}

TEST_F(WebPage, ServesAFileOnceAndThenItsEtag) {
  const std::string gzip = "Accept-Encoding: gzip\r\n";
  const Answer plain = ask(get("/app.js")), packed = ask(get("/app.js", gzip));
  EXPECT_EQ(plain.body, kTestPage[1].text);
  EXPECT_EQ(plain.field("Content-Encoding"), "");
  EXPECT_EQ(packed.field("Content-Encoding"), "gzip");
  EXPECT_LT(packed.body.size(), plain.body.size());
  EXPECT_NE(plain.field("ETag"), packed.field("ETag"));
  const Answer again =
      ask(get("/app.js", gzip + "If-None-Match: " + packed.field("ETag") + "\r\n"));
  EXPECT_EQ(again.status, 304);
  EXPECT_EQ(again.body, "");
  EXPECT_EQ(ask(get("/app.js", "If-None-Match: \"0\"\r\n")).status, 200);
}

TEST_F(WebPage, AnswersHeadWithoutABody) {
  HttpClient client = this->client();
  client.send("HEAD /app.js HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const Answer head = client.answer(true);
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.field("Content-Length"), std::to_string(kTestPage[1].text.size()));
  // The server has sent no body of /app.js before this answer.
  EXPECT_EQ(client.ask(get("/")).body, kTestPage[0].text);
}

TEST_F(WebPage, RejectsUnknownPathsMethodsAndTypes) {
  const auto asked = [this](const std::string& method, const std::string& path) {
    return ask(method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  };
  EXPECT_EQ(asked("GET", "/none").status, 404);
  for (const char* path : {"/../etc/passwd", "/%2e%2e/etc/passwd", "/..%2fetc/passwd", "/app.js%00",
                           "//app.js", "/\\..\\app.js"})
    EXPECT_EQ(asked("GET", path).status, 404) << path;
  EXPECT_EQ(asked("GET", "/rpc").field("Allow"), "POST");
  for (const char* method : {"OPTIONS", "PUT", "DELETE", "TRACE", "CONNECT", "PATCH", "BREW"}) {
    EXPECT_EQ(asked(method, "/").status, 405) << method;
    EXPECT_EQ(asked(method, "/rpc").status, 405) << method;
    EXPECT_EQ(asked(method, "/events").status, 405) << method;
  }
  EXPECT_EQ(asked("POST", "/").status, 405);
  EXPECT_EQ(asked("HEAD", "/events").status, 405);
  EXPECT_EQ(asked("OPTIONS", "/").field("Allow"), "GET, HEAD");
  EXPECT_EQ(status_of(get("/", "Content-Length: 1\r\n") + "x"), 400);
  for (const char* type :
       {"text/plain", "application/x-www-form-urlencoded", "application/jsonp", ""})
    EXPECT_EQ(status_of("POST /rpc HTTP/1.1\r\nHost: localhost\r\nContent-Type: " +
                        std::string(type) + "\r\nContent-Length: 2\r\n\r\n{}"),
              415)
        << type;
  EXPECT_EQ(status_of(get("/", "Host: a\r\n")), 400);
}

TEST_F(WebPage, AnswersRequestsAsTheSocketDoes) {
  RawClient socket(server_.path);
  HttpClient client = this->client();
  for (const std::string& request :
       {call("get_data"), call("subtract", "[42,23]"), call("none"),
        call("bytes", R"({"count":40})"), std::string("{"), std::string("[]"),
        "[" + call("get_data") + "," + call("later") + "]", call("later"),
        std::string(R"({"jsonrpc":"2.0","method":"sum","params":{"a":"x"},"id":"ä"})")}) {
    const Answer answer = client.ask(post(request));
    EXPECT_EQ(answer.status, 200) << request;
    EXPECT_EQ(answer.field("Content-Type"), "application/json");
    EXPECT_EQ(answer.body, socket.ask(request)) << request;
  }
  const Answer none = client.ask(post(R"({"jsonrpc":"2.0","method":"get_data"})"));
  EXPECT_EQ(none.status, 204);
  EXPECT_EQ(none.field("Content-Length"), "");
  EXPECT_EQ(client.ask(post("")).body.find(R"({"jsonrpc":"2.0","error":{"code":-32700)"), 0U);
}

// Many requests in one connection; they also arrive in the smallest possible parts.
TEST_F(WebPage, KeepsAConnectionForConsecutiveRequests) {
  HttpClient client = this->client();
  std::string all;
  for (int i = 0; i < 50; ++i) all += post(call("bytes", "[" + std::to_string(i) + "]")) + get("/");
  client.send(all);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(at(client.answer().body, "/result").size(), std::size_t(i) + 2) << i;
    EXPECT_EQ(client.answer().body, kTestPage[0].text);
  }
  for (const char byte : post(call("get_data"))) client.send(std::string(1, byte));
  EXPECT_EQ(client.answer().status, 200);
  client.send(get("/", "Connection: close\r\n"));
  EXPECT_EQ(client.answer().field("Connection"), "close");
  EXPECT_TRUE(client.closes());
}

TEST_F(WebPage, AnswersExpectContinueBeforeTheBodyArrives) {
  HttpClient client = this->client();
  const std::string body = call("get_data");
  const std::string request = post(body, "Expect: 100-continue\r\n");
  client.send(request.substr(0, request.size() - body.size()));
  EXPECT_EQ(client.until("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  EXPECT_EQ(client.ask(body).status, 200);
}

TEST_F(WebPage, OnlyTheTokenPermitsWriting) {
  const auto code = [this](const std::string& fields) {
    return at(ask(post(call("write"), fields)).body, "/error/code");
  };
  EXPECT_EQ(ask(post(call("write"), kOurs)).body, R"({"jsonrpc":"2.0","result":true,"id":1})");
  EXPECT_EQ(code(""), "-32003");
  EXPECT_EQ(code("Authorization: Bearer " + std::string(64, 'b') + "\r\n"), "-32003");
  EXPECT_EQ(code("Cookie: token=" + kTestToken + "\r\n"), "-32003");
  EXPECT_EQ(status_of(post(call("write"), kOurs + kOurs)), 400);
  const std::string why = at(ask(post(call("write"))).body, "/error/message");
  EXPECT_NE(why.find("mdof token"), std::string::npos) << why;
  // The token gives the permission for one request only.
  HttpClient client = this->client();
  EXPECT_EQ(at(client.ask(post(call("write"), kOurs)).body, "/result"), "true");
  EXPECT_EQ(at(client.ask(post(call("write"))).body, "/error/code"), "-32003");
  EXPECT_EQ(at(ask(post("[" + call("write") + "," + call("get_data") + "]")).body, "/0/error/code"),
            "-32003");
}

TEST_F(WebPage, RejectsPagesOfOtherSites) {
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"), 421);
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\nHost: mill.local:8080\r\n\r\n"), 200);
  EXPECT_EQ(status_of(post(call("get_data"), kOurs + "Origin: http://evil.example\r\n")), 403);
  EXPECT_EQ(status_of(post(call("get_data"), "Origin: null\r\n")), 403);
  EXPECT_EQ(status_of(post(call("get_data"), "Origin: http://localhost:1\r\n")), 200);
  EXPECT_EQ(status_of(get("/events?topics=value", "Origin: http://evil.example\r\n")), 403);
  EXPECT_EQ(status_of("OPTIONS /rpc HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.example\r\n"
                      "Access-Control-Request-Method: POST\r\n\r\n"),
            403);
  const Answer foreign = ask("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n");
  EXPECT_NE(foreign.body.find("hosts"), std::string::npos) << foreign.body;
}

TEST_F(WebPage, HasStreamsInsteadOfSubscriptions) {
  const std::string reply = ask(post(call("subscribe"), kOurs)).body;
  EXPECT_EQ(at(reply, "/error/code"), "-32003");
  EXPECT_NE(reply.find("GET /events"), std::string::npos) << reply;
}

std::string id_of(const std::string& event) {
  const auto at = event.find("id: ");
  return at == std::string::npos ? "" : event.substr(at + 4, event.find('\n', at) - at - 4);
}

TEST_F(WebPage, StreamsEventsAndTheNewestValues) {
  HttpClient client = this->client();
  client.send(get("/events?topics=value,event&interval_ms=20"));
  const std::string head = client.until("\r\n\r\n");
  EXPECT_NE(head.find("200 OK"), std::string::npos);
  EXPECT_NE(head.find("Content-Type: text/event-stream\r\n"), std::string::npos);
  const std::string begin = client.until("\n\n");
  EXPECT_EQ(begin, "retry: 2000\nid: " + id_of(begin) + "\n\n");
  publish("event", R"({"n":1})");
  const std::string first = client.until("\n\n");
  EXPECT_EQ(first, "id: " + std::to_string(std::stoull(id_of(begin)) + 1) +
                       "\nevent: event\ndata: {\"missed\":0,\"value\":{\"n\":1}}\n\n");
  publish("value", "7");
  EXPECT_EQ(client.until("\n\n"),
            "id: " + id_of(first) + "\nevent: value\ndata: {\"missed\":0,\"value\":7}\n\n");
}

TEST_F(WebPage, ResumesAStreamByItsLastEvent) {
  HttpClient first = client();
  first.send(get("/events?topics=event"));
  first.until("\r\n\r\n");
  const std::string begin = id_of(first.until("\n\n"));
  for (int i = 0; i < 3; ++i) publish("event", std::to_string(i));
  const std::string seen = id_of(first.until("\n\n"));
  HttpClient again = client();
  again.send(get("/events?topics=event", "Last-Event-ID: " + seen + "\r\n"));
  again.until("\n\n");
  EXPECT_NE(again.until("\n\n").find("\"value\":1}"), std::string::npos);
  EXPECT_NE(again.until("\n\n").find("\"value\":2}"), std::string::npos);
  publish("event", "3");
  EXPECT_NE(again.until("\n\n").find("\"value\":3}"), std::string::npos);
  HttpClient other = client();  // its last event id is from a previous process of mdofd
  other.send(get("/events?topics=event", "Last-Event-ID: 5\r\n"));
  other.until("\n\n");
  EXPECT_NE(other.until("\n\n").find("event: lost\ndata: {\"count\":null}\n\n"), std::string::npos);
}

TEST_F(WebPage, RejectsStreamsOfUnknownTopics) {
  EXPECT_EQ(status_of(get("/events")), 400);
  EXPECT_EQ(status_of(get("/events?topics=none")), 404);
  EXPECT_EQ(status_of(get("/events?topics=value&interval_ms=1")), 400);
  EXPECT_EQ(status_of(get("/events?topics=value&token=x")), 400);
}

class FewKeptEvents : public WebPage {
 protected:
  FewKeptEvents()
      : WebPage([] {
          ServerOptions o;
          o.max_kept_events = 4;
          o.http_heartbeat = 30ms;
          return o;
        }()) {}
};

TEST_F(FewKeptEvents, ReportsHowManyEventsAClientHasLost) {
  HttpClient first = client();
  first.send(get("/events?topics=event"));
  first.until("\r\n\r\n");
  const std::string begin = id_of(first.until("\n\n"));
  for (int i = 0; i < 10; ++i) publish("event", std::to_string(i));
  HttpClient again = client();
  again.send(get("/events?topics=event", "Last-Event-ID: " + begin + "\r\n"));
  again.until("\r\n\r\n");
  again.until("\n\n");
  EXPECT_NE(again.until("\n\n").find("event: lost\ndata: {\"count\":6}\n\n"), std::string::npos);
  EXPECT_NE(again.until("\n\n").find("\"value\":6}"), std::string::npos);
}

TEST_F(FewKeptEvents, KeepsAQuietStreamAlive) {
  HttpClient stream = client();
  stream.send(get("/events?topics=value"));
  stream.until("\r\n\r\n");
  stream.until("\n\n");
  EXPECT_EQ(stream.until("\n\n"), ":\n\n");
  EXPECT_EQ(stream.until("\n\n"), ":\n\n");
}

}  // namespace
}  // namespace mdof::rpc::test
