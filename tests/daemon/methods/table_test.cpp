// Properties of each method: the permission that it needs, and the parameters that it rejects by
// name.
#include <set>

#include "tests/daemon/methods/methods_fixture.h"

namespace mdof::daemon {
namespace {

using rpc::ParamType;

class MethodTableTest : public MethodsTest {
 protected:
  // The parameters of the method's example. The parameter `name` has the value `value`.
  static std::string with(const rpc::Method& method, const std::string& name,
                          const std::string& value) {
    std::string all = "{";
    simdjson::dom::parser parser;
    simdjson::dom::object example;
    if (!parser.parse(method.example).get(example))
      for (const auto [key, given] : example)
        if (key != name) all += "\"" + std::string(key) + "\":" + simdjson::minify(given) + ",";
    return all + "\"" + name + "\":" + value + "}";
  }
  const std::map<std::string, rpc::Method, std::less<>>& methods() {
    return bench_->table.methods();
  }
};

// Without the correct permissions, a client on TCP could change data, or any user could activate a
// table.
TEST_F(MethodTableTest, PermissionsAreAsListed) {
  const std::set<std::string> writing = {"run.start",
                                         "run.resume",
                                         "run.stop",
                                         "run.replay",
                                         "run.import",
                                         "squareness.fit",
                                         "encoder.set",
                                         "compensation.build",
                                         "compensation.build_volume",
                                         "compensation.activate",
                                         "compensation.deactivate"};
  const std::set<std::string> reading = {
      "rpc.discover",        "server.info",       "device.list",       "live.subscribe",
      "live.unsubscribe",    "run.list",          "run.get",           "run.points",
      "run.budget",          "run.compare",       "squareness.budget", "history.list",
      "compensation.status", "compensation.grid", "compensation.at",   "parallelism.fit",
      "machine.at",          "rig.get",           "compensation.list", "compensation.table",
      "server.health",       "run.trend",         "run.analyse"};
  const std::set<std::string> approving = {"compensation.activate", "compensation.deactivate"};
  for (const auto& [name, method] : methods()) {
    EXPECT_EQ(method.writes, writing.contains(name)) << name;
    EXPECT_EQ(method.approves, approving.contains(name)) << name;
    EXPECT_TRUE(writing.contains(name) || reading.contains(name)) << name << " is not known here";
  }
  EXPECT_EQ(methods().size(), writing.size() + reading.size());
}

TEST_F(MethodTableTest, AReadOnlyCallerChangesNothing) {
  add_axis();
  add_run();
  bench_->caller.writes = false;
  int refused = 0;
  for (const auto& [name, method] : methods()) {
    if (!method.writes) continue;
    const Answer answer = call(name, method.example);
    EXPECT_EQ(answer.code(), rpc::kForbidden) << answer.text();
    EXPECT_NE(answer.message().find(name), std::string::npos) << answer.text();
    ++refused;
  }
  EXPECT_EQ(refused, 11);
  EXPECT_EQ(bench_->stations[0]->run(), 0);
  EXPECT_EQ(call("run.list").number("/result/total"), 1);
}

TEST_F(MethodTableTest, OnlyApproversActivateATable) {
  const std::int64_t run = add_run();
  ASSERT_EQ(call("compensation.build", R"({"runs":[)" + std::to_string(run) + "]}").code(), 0);
  bench_->options.approvers = rpc::ServerOptions::Group{77, "metrology"};
  bench_->caller.group = 78;
  for (const char* name : {"compensation.activate", "compensation.deactivate"}) {
    const Answer refused = call(name, methods().find(name)->second.example);
    EXPECT_EQ(refused.code(), rpc::kForbidden) << refused.text();
    EXPECT_NE(refused.message().find("metrology"), std::string::npos) << refused.text();
  }
  bench_->caller.group = 77;
  EXPECT_EQ(
      call("compensation.activate", R"({"table":1,"despite_warnings":true})").at("/result/changed"),
      "true");
}

TEST_F(MethodTableTest, RejectsAValueOfAnotherTypeByName) {
  add_axis();
  int tried = 0;
  for (const auto& [name, method] : methods())
    for (const auto& param : method.params) {
      const bool text = param.type == ParamType::string;
      const Answer answer = call(name, with(method, param.name, text ? "7" : "\"seven\""));
      EXPECT_EQ(answer.code(), rpc::kInvalidParams) << answer.text();
      EXPECT_NE(answer.message().find(param.name), std::string::npos) << answer.text();
      ++tried;
    }
  EXPECT_GT(tried, 50);
}

TEST_F(MethodTableTest, RejectsValuesBeyondTheirBoundsOnly) {
  add_axis();
  const auto beyond = [](double x, double step) {
    return JsonWriter().value(std::abs(x) >= 1e15 ? 2 * x : x + step).take();
  };
  int tried = 0;
  const auto refused = [&](const rpc::Method& method, const rpc::Param& param,
                           const std::string& value) {
    const Answer answer = call(method.name, with(method, param.name, value));
    EXPECT_EQ(answer.code(), rpc::kInvalidParams) << method.name << ": " << answer.text();
    EXPECT_NE(answer.message().find(param.name), std::string::npos) << answer.text();
    ++tried;
  };
  for (const auto& [name, method] : methods())
    for (const auto& param : method.params) {
      const auto& bounds = param.bounds;
      if (param.type == ParamType::number || param.type == ParamType::integer) {
        refused(method, param, beyond(bounds.least, -1));
        refused(method, param, beyond(bounds.most, 1));
      } else if (param.type == ParamType::string && bounds.bytes < 30'000) {
        refused(method, param, "\"" + std::string(bounds.bytes + 1, 'x') + "\"");
      } else if (param.type == ParamType::array) {
        std::string list = "[0";
        for (std::size_t i = 0; i < bounds.items; ++i) list += ",1";
        refused(method, param, list + "]");
      }
    }
  EXPECT_GT(tried, 50);
}

TEST_F(MethodTableTest, ReportsMissingAndUnknownParametersByName) {
  for (const auto& [name, method] : methods()) {
    const Answer unknown = call(name, R"({"nonsense":1})");
    EXPECT_EQ(unknown.code(), rpc::kInvalidParams) << unknown.text();
    EXPECT_NE(unknown.message().find("nonsense"), std::string::npos) << unknown.text();
    for (const auto& param : method.params) {
      if (!param.required) continue;
      const Answer missed = call(name);
      EXPECT_EQ(missed.code(), rpc::kInvalidParams) << missed.text();
      EXPECT_NE(missed.message().find("is missing"), std::string::npos) << missed.text();
      break;
    }
  }
}

// The examples must be valid, because users copy them.
TEST_F(MethodTableTest, EveryExampleIsAccepted) {
  for (const auto& [name, method] : methods()) {
    const Answer answer = call(name, method.example);
    EXPECT_NE(answer.code(), rpc::kInvalidParams) << answer.text();
    EXPECT_NE(answer.code(), rpc::kInternalError) << answer.text();
  }
}

}  // namespace
}  // namespace mdof::daemon
