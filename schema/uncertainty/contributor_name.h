// Name of a line of an uncertainty budget, as data. The texts in English and German are in
// contributor_names.inc. Pure functions.
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

// The kind of component 0, 1 or 2: `first_kind`, or one of the two kinds that follow `first_kind`
// in contributor_names.inc.
constexpr ContributorKind of_component(ContributorKind first_kind, std::size_t component) {
  return static_cast<ContributorKind>(static_cast<std::size_t>(first_kind) + component);
}

struct ContributorName {
  ContributorKind kind = ContributorKind::noise_repeatability;
  std::string subject = {};            // id of the probe, of the plane or of the calibration record
  std::vector<std::string> runs = {};  // for a figure of two runs: one of them ("X"), or both

  bool operator==(const ContributorName&) const = default;
};

// `pattern` of contributor_names.inc with the subject inserted. For a figure of two runs, the names
// of the runs come first, joined by `and_word`: "X and Y, probe A: sensitivity".
std::string contributor_text(const ContributorName& name, std::string_view pattern,
                             std::string_view and_word);
// The English text, for the member "contributor" of documents. daemon/words/words.h has the German
// text.
std::string contributor_text(const ContributorName& name);

}  // namespace mdof
