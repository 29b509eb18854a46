#include "tests/daemon/rpc/rpc_fixture.h"

namespace mdof::rpc::test {
namespace {

class Requests : public ::testing::Test {
 protected:
  Requests() { server_.start(); }
  std::string ask(const std::string& request) { return RawClient(server_.path).ask(request); }
  std::string call(const std::string& method, const std::string& params) {
    return ask(R"({"jsonrpc":"2.0","method":")" + method + R"(","params":)" + params +
               R"(,"id":1})");
  }
  TestServer server_;
};

TEST_F(Requests, IdsAreReturnedUnchanged) {
  for (const char* id : {"1", "0", "-0", "-7", "1.50", "1e3", "0.1", "9007199254740993", "null",
                         R"("")", R"("a\"b\\c")", R"("µ")"})
    EXPECT_EQ(ask(std::string(R"({"jsonrpc":"2.0","method":"get_data","id":)") + id + "}"),
              std::string(R"({"jsonrpc":"2.0","result":["hello",5],"id":)") + id + "}");
  EXPECT_EQ(ask(R"([1, {"jsonrpc":"2.0","id" : 2.50 ,"method":"get_data"}])"),
            R"([{"jsonrpc":"2.0","error":{"code":-32600,"message":"Invalid Request"},"id":null},)"
            R"({"jsonrpc":"2.0","result":["hello",5],"id":2.50}])");
}

TEST_F(Requests, RejectsAnIdOfAnotherType) {
  for (const char* id : {"true", "[]", "{}"}) {
    const auto reply = ask(std::string(R"({"jsonrpc":"2.0","method":"get_data","id":)") + id + "}");
    EXPECT_EQ(at(reply, "/error/code"), "-32600");
    EXPECT_EQ(at(reply, "/id"), "null");
  }
  const std::string longest(300, 'i');
  EXPECT_EQ(
      at(ask(R"({"jsonrpc":"2.0","method":"get_data","id":")" + longest + "\"}"), "/error/code"),
      "-32600");
}

// RFC 8259, section 4: if two members have the same name, it is undefined which of them is used.
TEST_F(Requests, RejectsADuplicateMemberByName) {
  const std::string whole = R"("jsonrpc":"2.0","method":"get_data","params":[],"id":8)";
  const std::string twice[][3] = {{R"("jsonrpc":"2.0")", "jsonrpc", "8"},
                                  {R"("method":"get_data")", "method", "8"},
                                  {R"("method":"sum")", "method", "8"},
                                  {R"("params":[1])", "params", "8"},
                                  {R"("params":null)", "params", "8"},
                                  {R"("id":8)", "id", "null"},
                                  {R"("id":9)", "id", "null"},
                                  {R"("\u0069d":9)", "id", "null"}};
  for (const auto& [again, name, id] : twice)
    for (const std::string& request :
         {"{" + whole + "," + again + "}", "{" + again + "," + whole + "}"}) {
      const auto reply = ask(request);
      EXPECT_EQ(at(reply, "/error/code"), "-32600") << request;
      EXPECT_EQ(at(reply, "/id"), id) << request;
      EXPECT_NE(at(reply, "/error/data").find("\\\"" + name + "\\\""), std::string::npos) << reply;
      EXPECT_EQ(at(ask("[" + request + "]"), "/0/error/code"), "-32600") << request;
    }
  EXPECT_EQ(at(ask("{" + whole + R"(,"note":1,"note":2})"), "/result"), R"(["hello",5])");
}

TEST_F(Requests, RejectsOtherVersionsWithTheirId) {
  for (const char* version : {R"("1.0")", "2.0", "null"}) {
    const auto reply = ask(std::string(R"({"jsonrpc":)") + version + R"(,"method":"sum","id":8})");
    EXPECT_EQ(at(reply, "/error/code"), "-32600");
    EXPECT_EQ(at(reply, "/id"), "8");
    EXPECT_EQ(at(reply, "/error/data"), R"("member \"jsonrpc\" must be \"2.0\"")");
  }
  EXPECT_EQ(at(ask(R"({"jsonrpc":"2.0","method":"sum","params":3,"id":8})"), "/error/code"),
            "-32600");
}

TEST_F(Requests, AnUnknownMethodNamesTheNearest) {
  const auto reply = call("get_dat", "[]");
  EXPECT_EQ(at(reply, "/error/code"), "-32601");
  EXPECT_EQ(at(reply, "/error/message"), R"("Method not found")");
  EXPECT_EQ(at(reply, "/error/data"), R"("did you mean \"get_data\"?")");
}

TEST_F(Requests, ParametersAreCheckedAgainstTheTable) {
  const auto message = [&](const std::string& params) {
    const auto reply = call("subtract", params);
    EXPECT_EQ(at(reply, "/error/code"), "-32602") << params;
    return at(reply, "/error/message");
  };
  EXPECT_EQ(message(R"({"minuend":1,"subtrahent":2})"),
            R"("unknown parameter \"subtrahent\"; did you mean \"subtrahend\"?")");
  EXPECT_EQ(message(R"({"minuend":1,"q":2})"),
            R"("unknown parameter \"q\"; the parameters of subtract are: minuend, subtrahend")");
  EXPECT_EQ(message(R"({"minuend":1})"),
            R"x("parameter \"subtrahend\" is missing (integer: what)")x");
  EXPECT_EQ(message(R"({"minuend":"1","subtrahend":2})"),
            R"("parameter \"minuend\" must be of type integer, not a string")");
  EXPECT_EQ(
      message(R"({"minuend":1.5,"subtrahend":2})"),
      R"("parameter \"minuend\" must be of type integer, not a number with a fraction or with more than 64 bits")");
  EXPECT_EQ(message(R"({"minuend":1,"minuend":2,"subtrahend":2})"),
            R"("parameter \"minuend\" is given twice")");
  EXPECT_EQ(message("[1,2,3]"),
            R"("subtract takes at most 2 parameters by position: minuend, subtrahend")");
  EXPECT_EQ(message("[null,2]"), R"("parameter \"minuend\" must be of type integer, not null")");
  EXPECT_EQ(at(call("sum", R"({"a":1,"b":null,"c":3.0})"), "/result"), "4");
}

TEST_F(Requests, ALongNameIsNotReturnedInFull) {
  const std::string name(60000, 'n');
  EXPECT_LT(call("sum", "{\"" + name + "\":1}").size(), 400u);
  EXPECT_EQ(at(call(name, "[]"), "/error/code"), "-32601");
}

TEST_F(Requests, TooLargeResultsAskForPages) {
  // For id 1, the reply around the string has 36 bytes. This number includes the quotes of the
  // string, but not the line feed.
  EXPECT_EQ(call("bytes", "[49115]").size(), 49151u);
  const auto reply = call("bytes", "[49116]");
  EXPECT_EQ(at(reply, "/error/code"), "-32013");
  EXPECT_NE(at(reply, "/error/message").find("a part of the result (offset, count)"),
            std::string::npos);
}

TEST_F(Requests, ABatchKeepsRepliesThatFitAndNamesTheOthers) {
  std::string batch;
  for (int i = 0; i < 100; ++i)
    batch += (i ? "," : "[") +
             std::string(R"({"jsonrpc":"2.0","method":"bytes","params":[2000],"id":)") +
             std::to_string(i) + "}";
  const auto reply = ask(batch + "]");
  EXPECT_LT(reply.size(), 49152u);
  int results = 0, errors = 0;
  for (int i = 0; i < 100; ++i) {
    const std::string member = "/" + std::to_string(i);
    EXPECT_EQ(at(reply, member + "/id"), std::to_string(i));
    results += !at(reply, member + "/result").empty();
    errors += at(reply, member + "/error/code") == "-32013";
  }
  EXPECT_EQ(results + errors, 100);
  EXPECT_GT(results, 2);
  EXPECT_GT(errors, 2);
}

TEST_F(Requests, LinesMayEndInCrLfAndBeEmpty) {
  RawClient client(server_.path);
  client.send("\r\n\n{\"jsonrpc\":\"2.0\",\"method\":\"get_data\",\"id\":1}\r\n");
  EXPECT_EQ(client.line(), R"({"jsonrpc":"2.0","result":["hello",5],"id":1})");
}

TEST_F(Requests, RepliesToAClientThatHasShutDownSending) {
  RawClient client(server_.path);
  client.send("{\"jsonrpc\":\"2.0\",\"method\":\"get_data\",\"id\":1}\n{\"jsonrpc\":");
  ::shutdown(client.fd(), SHUT_WR);
  EXPECT_EQ(at(client.line(), "/result"), R"(["hello",5])");
  EXPECT_EQ(at(client.line(), "/error/code"), "-32700");
  EXPECT_EQ(client.line(), "<closed>");
  EXPECT_TRUE(server_.connections_become(0));
}

TEST_F(Requests, PipelinedRequestsAreAllAnswered) {
  RawClient client(server_.path);
  std::string all;
  for (int i = 0; i < 5000; ++i)
    all += R"({"jsonrpc":"2.0","method":"bytes","params":[1000],"id":)" + std::to_string(i) + "}\n";
  std::thread sender([&] { client.send(all); });
  std::this_thread::sleep_for(100ms);  // the server reaches its limit and must stop reading
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(at(client.line(), "/id"), std::to_string(i));
  sender.join();
}

TEST_F(Requests, DiscoverDescribesEveryMethod) {
  const auto document = at(call("rpc.discover", "[]"), "/result");
  EXPECT_EQ(at(document, "/openrpc"), R"("1.2.6")");
  EXPECT_EQ(at(document, "/x-total"), std::to_string(server_.table.methods().size()));
  EXPECT_EQ(at(document, "/x-next-offset"), "");
  int i = 0;
  for (const auto& [name, method] : server_.table.methods()) {
    const std::string row = "/methods/" + std::to_string(i++);
    EXPECT_EQ(at(document, row + "/name"), "\"" + name + "\"");
    EXPECT_NE(at(document, row + "/result/schema"), "");
    EXPECT_NE(at(document, row + "/params"), "");
  }
  EXPECT_EQ(at(document, "/methods/8/params/0/schema/type"), R"("integer")");
}

TEST_F(Requests, DiscoverIsPagedIfItDoesNotFit) {
  EXPECT_EQ(at(call("rpc.discover", "[]"), "/result/components/errors/changed/code"), "-32001");
  EXPECT_EQ(at(call("rpc.discover", "[]"), "/result/components/errors/conflict/code"), "-32002");
  std::size_t offset = 0, seen = 0, pages = 0;
  for (; pages < 20; ++pages) {
    const auto page = at(call("rpc.discover", "[" + std::to_string(offset) + ",4096]"), "/result");
    ASSERT_LT(page.size(), 4096u);
    while (!at(page, "/methods/" + std::to_string(seen - offset)).empty()) ++seen;
    const auto next = at(page, "/x-next-offset");
    if (next.empty()) break;
    offset = std::stoul(next);
    ASSERT_EQ(offset, seen);
  }
  EXPECT_EQ(seen, server_.table.methods().size());
  EXPECT_EQ(at(call("rpc.discover", "[-1]"), "/error/code"), "-32602");
}

TEST_F(Requests, EveryExampleIsAnswered) {
  for (const auto& [name, method] : server_.table.methods())
    EXPECT_NE(at(call(name, method.example), "/result"), "") << name;
}

}  // namespace
}  // namespace mdof::rpc::test
