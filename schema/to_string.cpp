// Converts enumerations to text.
#include "schema/point.h"
#include "schema/run.h"
#include "schema/sample.h"
#include "schema/study/study.h"

namespace mdof {

const char* to_string(Quality quality) {
  switch (quality) {
    case Quality::good:
      return "good";
    case Quality::simulated:
      return "simulated";
    case Quality::suspect:
      return "suspect";
    case Quality::over_range:
      return "over_range";
    case Quality::stale:
      return "stale";
    case Quality::missing:
      return "missing";
  }
  return "missing";
}

const char* suffix(Unit unit) {
  switch (unit) {
    case Unit::um:
      return "um";
    case Unit::mm:
      return "mm";
    case Unit::volt:
      return "V";
    case Unit::deg_c:
      return "C";
    case Unit::metre:
      return "m";
    case Unit::other:
      break;
  }
  return "";
}

const char* to_string(Model model) {
  switch (model) {
    case Model::simplified:
      return "simplified";
    case Model::exact:
      return "exact";
    case Model::rigid:
      break;
  }
  return "rigid";
}

bool model_from(std::string_view name, Model& model) {
  for (const Model m : {Model::simplified, Model::exact, Model::rigid}) {
    if (name == to_string(m)) {
      model = m;
      return true;
    }
  }
  return false;
}

const char* to_string(RunState state) {
  switch (state) {
    case RunState::open:
      return "open";
    case RunState::complete:
      return "complete";
    case RunState::partial:
      return "partial";
    case RunState::aborted:
      return "aborted";
    case RunState::ended:
      return "ended";
    case RunState::failed:
      break;
  }
  return "failed";
}

const char* to_string(StudyState state) {
  return state == StudyState::complete ? "complete" : "interrupted";
}

}  // namespace mdof
