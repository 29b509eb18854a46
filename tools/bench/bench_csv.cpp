// Measures the speed of reading the CSV files of the benchmark: with the row parser alone on one
// thread, with the complete CsvRows (reading, hashing, parsing), and with pandas.read_csv.
//   bench_csv log|frames FILE [REPEATS]   FILE: from generate_log; prints the best of REPEATS (5)
//   times
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "drivers/csv/byte_source.h"
#include "drivers/csv/csv_rows.h"
#include "drivers/csv/line_reader.h"
#include "schema/base/number/number.h"

namespace {

using namespace mdof;
using namespace mdof::drivers;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

[[noreturn]] void die(const std::string& message) {
  std::fprintf(stderr, "bench_csv: %s\n", message.c_str());
  std::exit(3);
}

template <class T>
T value(Result<T> result) {
  if (!result) die(result.error().message);
  return std::move(*result);
}

struct Figures {
  double seconds = 0;
  std::uint64_t rows = 0, fields = 0, bytes = 0;
};

void print(const char* what, const Figures& f) {
  std::printf("%-34s %7.1f ms  %6.0f MB/s  %5.2f ns a field\n", what, f.seconds * 1e3,
              static_cast<double>(f.bytes) / f.seconds / 1e6,
              f.seconds * 1e9 / static_cast<double>(f.fields));
}

// Measures only the parsing: the file is in memory and already divided into chunks.
class ParseAlone {
 public:
  ParseAlone(const std::string& path, CsvKind kind) : kind_(kind), path_(path) {
    auto source = value(ByteSource::open(path, false));
    LineReader lines(*source, std::size_t{1} << 20);
    for (;;) {
      LineChunk chunk;
      if (Status status = lines.read(chunk); !status) die(status.error().message);
      if (chunk.text().empty()) break;
      bytes_ += chunk.text().size();
      chunks_.push_back(std::move(chunk));
    }
  }
  Figures run() const {
    const CsvHeader header = value(parse_csv_header(chunks_[0].text(), kind_, path_));
    const std::size_t skip = header.bytes;
    CsvRowParser parser(header, {});
    SampleBlock block;
    const double begin = now_s();
    for (const LineChunk& chunk : chunks_) {
      parser.give(chunk.text().substr(&chunk == chunks_.data() ? skip : 0));
      while (value(parser.next(block))) {
      }
    }
    const double seconds = now_s() - begin;
    return {seconds, parser.rows(), parser.rows() * header.columns.size(), bytes_};
  }

 private:
  CsvKind kind_;
  std::string path_;
  std::vector<LineChunk> chunks_;
  std::uint64_t bytes_ = 0;
};

Figures end_to_end(const std::string& path, CsvRowsOptions options) {
  const double begin = now_s();
  auto rows = value(CsvRows::open(path, options));
  SampleBlock block;
  Figures figures;
  while (value(rows->next(block)) == ReadState::more) figures.rows += block.scans();
  figures.seconds = now_s() - begin;
  figures.fields = figures.rows * rows->header().columns.size();
  figures.bytes = rows->bytes();
  return figures;
}

// Measures the conversion of all values in the file to texts with 17 digits.
Figures print_17(const std::string& path, CsvRowsOptions options) {
  auto rows = value(CsvRows::open(path, options));
  SampleBlock block;
  std::vector<double> values;
  while (value(rows->next(block)) == ReadState::more && values.size() < 2'000'000)
    for (const auto& column : block.value)
      values.insert(values.end(), column.begin(), column.end());
  std::vector<char> text(values.size() * kDouble17Size);
  std::memset(text.data(), 1, text.size());
  char* out = text.data();
  const double begin = now_s();
  for (const double x : values) {
    out = write_double_17(out, x);
    *out++ = ',';
  }
  return {now_s() - begin, 0, values.size(), static_cast<std::uint64_t>(out - text.data())};
}

template <class Run>
Figures best(int runs, Run run) {
  Figures best = run();
  for (int i = 1; i < runs; ++i)
    if (const Figures again = run(); again.seconds < best.seconds) best = again;
  return best;
}

// The time of pandas.read_csv in s, without the import of pandas; 0: pandas is not installed.
double pandas_s(const std::string& path, int runs) {
  ::setenv("BENCH_FILE", path.c_str(), 1);
  ::setenv("BENCH_RUNS", std::to_string(runs).c_str(), 1);
  std::FILE* const python = ::popen(
      "/usr/bin/python3 -c 'import os, time, pandas\n"
      "best = 1e9\n"
      "for _ in range(int(os.environ[\"BENCH_RUNS\"])):\n"
      "    begin = time.perf_counter()\n"
      "    pandas.read_csv(os.environ[\"BENCH_FILE\"])\n"
      "    best = min(best, time.perf_counter() - begin)\n"
      "print(best)' 2>/dev/null",
      "r");
  double seconds = 0;
  if (!python || std::fscanf(python, "%lf", &seconds) != 1) seconds = 0;
  if (python) ::pclose(python);
  return seconds;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_csv log|frames FILE [REPEATS]\n");
    return 2;
  }
  const std::string path = argv[2];
  const int runs = argc > 3 ? std::max(1, std::atoi(argv[3])) : 5;
  CsvRowsOptions options;
  options.kind = std::string(argv[1]) == "frames" ? CsvKind::frames : CsvKind::probe_log;
  {
    const ParseAlone parse(path, options.kind);
    print("parse alone, one thread", best(runs, [&] { return parse.run(); }));
  }
  const Figures whole = best(runs, [&] { return end_to_end(path, options); });
  print("read, SHA-256, parse: CsvRows", whole);
  options.sha256 = false;
  print("read, parse: CsvRows", best(runs, [&] { return end_to_end(path, options); }));
  print("print with 17 digits", best(runs, [&] { return print_17(path, options); }));
  if (const double seconds = pandas_s(path, runs); seconds > 0) {
    Figures pandas = whole;
    pandas.seconds = seconds;
    print("pandas.read_csv", pandas);
    std::printf("pandas takes %.1f times as long as CsvRows with SHA-256\n",
                seconds / whole.seconds);
  } else {
    std::printf("pandas.read_csv: /usr/bin/python3 has no pandas, not compared\n");
  }
}
