#include "bindings/keywords.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lutka::python {

void Keywords::refuse(const char* name, double low, double high) const {
    raise({ErrorCode::usage, fmt::format("{} is {}", name, std::string(py::repr(given_[name]))), call_ + "()",
           fmt::format("give a number in [{}, {}]", low, high)});
}

void Keywords::refuseWord(const char* name, const std::string& word, const std::vector<std::string>& words) const {
    raise({ErrorCode::usage, fmt::format("'{}' is no {}", word, name), call_ + "()",
           fmt::format("one of {}", fmt::join(words, ", "))});
}

void Keywords::finish() const {
    for (const auto& [key, value] : given_) {
        const auto name = key.cast<std::string>();
        if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
        throw py::type_error(
            fmt::format("{}() has no argument '{}'; it takes {}", call_, name, fmt::join(known_, ", ")));
    }
}

}  // namespace lutka::python
