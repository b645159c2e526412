#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>

#include "bindings/errors.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::python {

/// A profile in Python's hands. Always valid: a change that validate() objects to is undone and raised. Its bodies and
/// constraints stay the same in number, so that what stands for one of them never goes stale.
class ProfileObject {
  public:
    explicit ProfileObject(physics::RagdollProfile profile) : profile_(std::move(profile)) {}

    [[nodiscard]] const physics::RagdollProfile& get() const { return profile_; }
    /// Applies the change or raises UsageError with all that is wrong. The total mass follows the bodies'.
    void edit(const std::function<void(physics::RagdollProfile&)>& change);

  private:
    physics::RagdollProfile profile_;
};

/// One body or constraint of a profile, which it keeps alive.
struct BodyObject {
    std::shared_ptr<ProfileObject> profile;
    std::size_t index = 0;
    [[nodiscard]] const physics::BodyProfile& get() const { return profile->get().bodies[index]; }
};
struct ConstraintObject {
    std::shared_ptr<ProfileObject> profile;
    std::size_t index = 0;
    [[nodiscard]] const physics::ConstraintProfile& get() const { return profile->get().constraints[index]; }
};

void bindProfile(py::module_& module);

}  // namespace lutka::python
