// What a line of an uncertainty budget is named, as data. Its words in English and German:
// contributor_names.inc. Pure.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mdof {

enum class ContributorKind {
#define CONTRIBUTOR(code, english, german) code,
#include "schema/uncertainty/contributor_names.inc"
#undef CONTRIBUTOR
};

// `x_kind` or the one of the next component behind it, in the order of contributor_names.inc.
constexpr ContributorKind of_component(ContributorKind x_kind, std::size_t component) {
  return static_cast<ContributorKind>(static_cast<std::size_t>(x_kind) + component);
}

struct ContributorName {
  ContributorKind kind = ContributorKind::noise_repeatability;
  std::string subject = {};            // id of its probe, plane or calibration record
  std::vector<std::string> runs = {};  // of a figure of two runs: "X", or both

  bool operator==(const ContributorName&) const = default;
};

// `pattern` of contributor_names.inc with the subject put in; of a figure of two runs their names
// before it, joined by `and_word`: "X and Y, probe A: sensitivity".
std::string contributor_text(const ContributorName& name, std::string_view pattern,
                             std::string_view and_word);
// In English: "contributor" of documents. German is in daemon/words/words.h.
std::string contributor_text(const ContributorName& name);

}  // namespace mdof
