// Every example of section 7 of the JSON-RPC 2.0 specification, word for word.
#include "tests/daemon/rpc/rpc_fixture.h"

namespace mdof::rpc::test {
namespace {

class Specification : public ::testing::Test {
 protected:
  Specification() { server_.start(); }

  // If the expected reply is empty, the next line must be the answer to a later request.
  void expect(const std::string& request, const std::string& reply) {
    RawClient client(server_.path);
    std::string line = request;
    std::replace(line.begin(), line.end(), '\n', ' ');
    ASSERT_TRUE(client.send(line + "\n"));
    if (!reply.empty()) {
      EXPECT_EQ(canonical(client.line()), canonical(reply)) << request;
    }
    EXPECT_EQ(client.ask(R"({"jsonrpc":"2.0","method":"get_data","id":"end"})"),
              R"({"jsonrpc":"2.0","result":["hello",5],"id":"end"})");
  }

  TestServer server_;
};

TEST_F(Specification, CallsWithPositionalParameters) {
  expect(R"({"jsonrpc": "2.0", "method": "subtract", "params": [42, 23], "id": 1})",
         R"({"jsonrpc": "2.0", "result": 19, "id": 1})");
  expect(R"({"jsonrpc": "2.0", "method": "subtract", "params": [23, 42], "id": 2})",
         R"({"jsonrpc": "2.0", "result": -19, "id": 2})");
}

TEST_F(Specification, CallsWithNamedParameters) {
  expect(
      R"({"jsonrpc": "2.0", "method": "subtract", "params": {"subtrahend": 23, "minuend": 42}, "id": 3})",
      R"({"jsonrpc": "2.0", "result": 19, "id": 3})");
  expect(
      R"({"jsonrpc": "2.0", "method": "subtract", "params": {"minuend": 42, "subtrahend": 23}, "id": 4})",
      R"({"jsonrpc": "2.0", "result": 19, "id": 4})");
}

TEST_F(Specification, NotificationsHaveNoReply) {
  expect(R"({"jsonrpc": "2.0", "method": "update", "params": [1,2,3,4,5]})", "");
  expect(R"({"jsonrpc": "2.0", "method": "foobar"})", "");
}

TEST_F(Specification, NonExistentMethod) {
  expect(
      R"({"jsonrpc": "2.0", "method": "foobar", "id": "1"})",
      R"({"jsonrpc": "2.0", "error": {"code": -32601, "message": "Method not found"}, "id": "1"})");
}

TEST_F(Specification, InvalidJson) {
  expect(R"({"jsonrpc": "2.0", "method": "foobar, "params": "bar", "baz])",
         R"({"jsonrpc": "2.0", "error": {"code": -32700, "message": "Parse error"}, "id": null})");
}

TEST_F(Specification, InvalidRequestObject) {
  expect(
      R"({"jsonrpc": "2.0", "method": 1, "params": "bar"})",
      R"({"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null})");
}

TEST_F(Specification, BatchOfInvalidJson) {
  expect(R"([
  {"jsonrpc": "2.0", "method": "sum", "params": [1,2,4], "id": "1"},
  {"jsonrpc": "2.0", "method"
])",
         R"({"jsonrpc": "2.0", "error": {"code": -32700, "message": "Parse error"}, "id": null})");
}

TEST_F(Specification, EmptyArray) {
  expect(
      "[]",
      R"({"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null})");
}

TEST_F(Specification, InvalidButNotEmptyBatch) {
  expect("[1]", R"([
  {"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null}
])");
}

TEST_F(Specification, InvalidBatch) {
  expect("[1,2,3]", R"([
  {"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null},
  {"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null},
  {"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null}
])");
}

TEST_F(Specification, Batch) {
  expect(R"([
        {"jsonrpc": "2.0", "method": "sum", "params": [1,2,4], "id": "1"},
        {"jsonrpc": "2.0", "method": "notify_hello", "params": [7]},
        {"jsonrpc": "2.0", "method": "subtract", "params": [42,23], "id": "2"},
        {"foo": "boo"},
        {"jsonrpc": "2.0", "method": "foo.get", "params": {"name": "myself"}, "id": "5"},
        {"jsonrpc": "2.0", "method": "get_data", "id": "9"}
    ])",
         R"([
        {"jsonrpc": "2.0", "result": 7, "id": "1"},
        {"jsonrpc": "2.0", "result": 19, "id": "2"},
        {"jsonrpc": "2.0", "error": {"code": -32600, "message": "Invalid Request"}, "id": null},
        {"jsonrpc": "2.0", "error": {"code": -32601, "message": "Method not found"}, "id": "5"},
        {"jsonrpc": "2.0", "result": ["hello", 5], "id": "9"}
    ])");
}

TEST_F(Specification, BatchOfNotificationsHasNoReply) {
  expect(R"([
        {"jsonrpc": "2.0", "method": "notify_sum", "params": [1,2,4]},
        {"jsonrpc": "2.0", "method": "notify_hello", "params": [7]}
    ])",
         "");
}

}  // namespace
}  // namespace mdof::rpc::test
