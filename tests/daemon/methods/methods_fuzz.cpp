// Calls every method of mdofd with lines of JSON-RPC. For any input, the output is empty or one
// line of JSON within the size limit, and every call is answered. All inputs use the same store
// and axis. Therefore an input can read data that an earlier input stored.
#include <simdjson.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "daemon/store/file/writer_lock.h"
#include "drivers/registry.h"
#include "schema/rig/rig.h"
#include "schema/units.h"
#include "tests/daemon/methods/methods_bench.h"
#include "tests/drivers/fuzz_folder.h"

namespace {

using namespace mdof;
using namespace mdof::daemon;

namespace fs = std::filesystem;

Rig rig_of(char axis) {
  return load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_" + axis + ".toml").value();
}

// A run as from a short log: six stops in both directions, with slightly different errors.
Run made_run(char axis, std::int64_t number) {
  const Rig rig = rig_of(axis);
  Run run;
  run.header.axis = rig.axis;
  run.header.state = RunState::complete;
  run.header.started_utc = "2026-11-23T07:00:00.000Z";
  run.header.provenance.recording_kind = "csv";
  run.header.provenance.recording_sha256 = std::string(63, '0') + std::to_string(number);
  run.header.provenance.rig_text = rig.text;
  run.header.provenance.model = "rigid";
  run.header.stated = kAtFixture;
  for (int i = 0; i < 6; ++i) {
    MeasuredPoint& p = run.points.emplace_back();
    p.target = i < 3 ? i + 1 : 6 - i;
    p.run = 1;
    p.point.begin_ns = (10 * number + i) * kNsPerS;
    p.point.end_ns = p.point.begin_ns + kNsPerS / 2;
    p.point.direction = i < 3 ? 1 : -1;
    p.target_m = p.point.position_m = 5e-3 * (p.target - 1);
    p.point.probe_m = p.point.probe_u_m = {1e-6, 2e-6, 3e-6, 4e-6, 5e-6};
    p.point.samples = 100;
    p.errors.valid = true;
    p.errors.local = {1e-6 * i, 2e-6, 3e-6 * i, 4e-6, 5e-6};
    for (std::size_t k = 0; k < 5; ++k) p.errors.covariance[6 * k] = 1e-18;
  }
  return run;
}

// A driver without samples: a run of its axis ends immediately after its start.
class NoSamples final : public drivers::Driver {
 public:
  drivers::DeviceInfo info() const override { return {}; }
  Status open() override { return {}; }
  Result<drivers::ReadState> read(SampleBlock& block, std::chrono::milliseconds) override {
    block = SampleBlock();
    return drivers::ReadState::end;
  }
};

std::unique_ptr<Station> empty_axis(Storekeeper& keeper, const fs::path& folder) {
  drivers::DriverSpec spec;
  spec.driver = spec.name = "log";
  spec.live = spec.recorded = false;
  spec.make = []() -> Result<std::unique_ptr<drivers::Driver>> {
    return std::make_unique<NoSamples>();
  };
  spec.source_info = [](const drivers::Driver&) { return drivers::SourceInfo{}; };
  return std::make_unique<Station>(
      AxisConfig{rig_of('X'), {spec}}, PipelineOptions(), "", folder, keeper,
      StationEvents{[](const std::string&) {}, [](const std::string&) {},
                    [](Axis, std::int64_t, const Trouble&) {}});
}

struct Served {
  FuzzFolder folder;
  MethodsBench bench{folder.path(), store::Durability::off};
  simdjson::dom::parser parser;

  Served() {
    // The lock stores data for the whole process. These data must outlive this object.
    (void)store::WriterLock::open_runs_claimed(folder.path() / "mdof.db");
    const auto stored = bench.keeper->run([](store::Store& store) -> Result<std::string> {
      std::int64_t number = 0;
      for (const char axis : {'X', 'Y', 'X'}) MDOF_CHECK(store.add_run(made_run(axis, ++number)));
      return "";
    });
    if (!stored) std::abort();
    bench.stations.push_back(empty_axis(*bench.keeper, folder.path()));
    answer(R"({"jsonrpc":"2.0","id":1,"method":"compensation.build","params":{"runs":[1]}})");
    answer(R"({"jsonrpc":"2.0","id":1,"method":"compensation.activate",)"
           R"("params":{"table":1,"simulated":true,"despite_warnings":true}})");
    // Without an active table, half of the methods cannot be tested.
    if (!bench.active.axes[0]) std::abort();
  }

  void answer(std::string_view line) {
    const std::string out = bench.call(line);
    if (out.empty()) return;
    if (out.size() >= bench.options.max_reply_bytes || out.find('\n') != std::string::npos)
      std::abort();
    simdjson::dom::element reply;
    if (parser.parse(out).get(reply)) std::abort();
    std::int64_t code = 0;
    if (!reply.at_pointer("/error/code").get(code) && code == -32603) std::abort();
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Served served;
  const std::string_view lines(reinterpret_cast<const char*>(data), size);
  for (std::size_t begin = 0, calls = 0; begin < size && calls < 4; ++calls) {
    const std::size_t end = std::min(lines.find('\n', begin), size);
    served.answer(lines.substr(begin, end - begin));
    begin = end + 1;
  }
  return 0;
}
