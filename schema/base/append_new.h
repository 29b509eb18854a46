// Appends those items of `more` that `to` does not contain yet, in the order of `more`.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace mdof {

template <class T>
void append_new(std::vector<T>& to, std::vector<T> more) {
  for (T& each : more)
    if (std::find(to.begin(), to.end(), each) == to.end()) to.push_back(std::move(each));
}

}  // namespace mdof
