#include "tools/mdof/solve/error_rows.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>

#include "schema/base/number/number.h"
#include "schema/base/thread_start.h"
#include "schema/units.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

constexpr std::size_t kMaxKeyLength = 16;             // length of ,"EYX_um":
constexpr std::size_t kRowColumns = kErrorCount + 1;  // the position is last
constexpr std::size_t kMaxRowLength = kRowColumns * (kDouble17Size + kMaxKeyLength) + 8;
constexpr std::size_t kAtOnce = 8;
constexpr std::size_t kBlocks = 4;
constexpr int kPipeBytes = 1 << 20;

char* append(char* out, std::string_view text) {
  std::memcpy(out, text.data(), text.size());
  return out + text.size();
}

double in_key_unit(const ErrorName& name, const SolvedRows& rows, std::size_t row) {
  return to_key_unit(name.sign * rows.local[name.local][row]) + 0.0;  // converts -0 to 0
}

// The position in mm as it was written in the file: removes the rounding error of the conversion to
// metres.
double restore_written_mm(double encoder_m) {
  const double mm = to_mm(encoder_m), written = std::round(mm * 1e9) / 1e9;
  return (std::abs(written - mm) < 4e-16 * std::abs(mm) ? written : mm) + 0.0;
}

}  // namespace

ErrorRows::ErrorRows(RowForm form, const MovingAxis& moving, Model model)
    : form_(form), names_(error_names(moving.axis)), filled_(kBlocks), free_(kBlocks) {
  for (std::size_t i = 0; i < kBlocks; ++i) free_.try_push({});
  for (ErrorName& name : names_) name.sign *= moving.sides.error_sign();
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    json_keys_[k] = std::string(k == 0 ? "{\"" : ",\"") + names_[k].key + "\":";
    head_ += std::string(names_[k].key) + ",";
  }
  json_keys_[kErrorCount] = ",\"encoder_mm\":";
  head_ += "encoder_mm\n";
  if (form == RowForm::json) {
    head_ = "{\"axis\":\"" + std::string(1, letter(moving.axis)) + "\",\"model\":\"" +
            to_string(model) + "\",\"reference\":\"carriage\",\"rows\":[";
  }
  ::fcntl(STDOUT_FILENO, F_SETPIPE_SZ, kPipeBytes);  // a larger pipe needs fewer context switches
  thread_ = std::thread([this] { work(); });
}

ErrorRows::~ErrorRows() {
  std::deque<SolvedRows> rest;
  filled_.pop_all(rest, {});
  filled_.close();
  if (thread_.joinable()) thread_.join();
}

SolvedRows* ErrorRows::next() {
  auto block = free_.pop();
  if (!block) return nullptr;
  filling_ = std::move(*block);
  return &filling_;
}

void ErrorRows::put() {
  filled_.push(std::move(filling_));
}

Status ErrorRows::finish() {
  filled_.close();
  thread_.join();
  return status_;
}

void ErrorRows::work() {
  start_thread_as("write rows");
  status_ = write_all();
  std::deque<SolvedRows> rest;
  free_.pop_all(rest, {});
  free_.close();
}

Status ErrorRows::write_all() {
  MDOF_CHECK(write_commands(head_));
  while (auto rows = filled_.pop()) {
    text_.resize(std::max(text_.size(), rows->size() * kMaxRowLength));
    char* const begin = text_.data();
    char* const end = form_ == RowForm::csv ? append_csv(*rows, begin) : append_json(*rows, begin);
    free_.try_push(std::move(*rows));
    MDOF_CHECK(write_commands({begin, static_cast<std::size_t>(end - begin)}));
  }
  return form_ == RowForm::json ? write_commands("]}\n") : Status();
}

// The texts of up to kAtOnce rows, ordered by column. In an unsolved row the errors are empty
// texts.
struct ErrorRows::Texts {
  std::array<std::array<DoubleText, kAtOnce>, kRowColumns> of;

  void fill(const std::array<ErrorName, 5>& names, const SolvedRows& rows, std::size_t begin,
            std::size_t n) {
    std::array<double, kAtOnce> x;
    for (std::size_t k = 0; k < kRowColumns; ++k) {
      for (std::size_t j = 0; j < n; ++j)
        x[j] = k == kErrorCount ? restore_written_mm(rows.encoder_m[begin + j])
                                : in_key_unit(names[k], rows, begin + j);
      write_doubles_17(x.data(), n, of[k].data());
      for (std::size_t j = 0; j < n; ++j) of[k][j].size = std::isfinite(x[j]) ? of[k][j].size : 0;
    }
  }
  // Appends a text. Copies the whole buffer, because copying a constant length is faster; the next
  // text overwrites the rest.
  char* append(char* out, std::size_t k, std::size_t j) const {
    std::memcpy(out, of[k][j].text, kDouble17Size);
    return out + of[k][j].size;
  }
};

char* ErrorRows::append_csv(const SolvedRows& rows, char* out) const {
  Texts texts;
  for (std::size_t begin = 0; begin < rows.size(); begin += kAtOnce) {
    const std::size_t n = std::min(kAtOnce, rows.size() - begin);
    texts.fill(names_, rows, begin, n);
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < kRowColumns; ++k) {
        out = texts.append(out, k, j);
        *out++ = ',';
      }
      out[-1] = '\n';
    }
  }
  return out;
}

char* ErrorRows::append_json(const SolvedRows& rows, char* out) {
  Texts texts;
  for (std::size_t begin = 0; begin < rows.size(); begin += kAtOnce) {
    const std::size_t n = std::min(kAtOnce, rows.size() - begin);
    texts.fill(names_, rows, begin, n);
    for (std::size_t j = 0; j < n; ++j) {
      if (!first_row_) *out++ = ',';
      first_row_ = false;
      for (std::size_t k = 0; k < kRowColumns; ++k) {
        out = append(out, json_keys_[k]);
        out = texts.of[k][j].size > 0 ? texts.append(out, k, j) : append(out, "null");
      }
      *out++ = '}';
    }
  }
  return out;
}

}  // namespace mdof::tools
