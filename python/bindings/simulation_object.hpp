#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bindings/ragdoll_object.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::python {

/// A simulation in Python's hands. One thread at a time uses it, others wait; nobody holds the GIL meanwhile.
class SimulationObject {
  public:
    SimulationObject(std::vector<RagdollPointer> assets, std::unique_ptr<scene::Simulation> simulation)
        : assets_(std::move(assets)), simulation_(std::move(simulation)) {}

    /// Calls `work`, which touches no Python object, with the simulation alone and without the GIL.
    template <class Work>
    auto use(const Work& work) {
        const py::gil_scoped_release released;
        const std::lock_guard alone(mutex_);
        return work(*simulation_);
    }
    /// use() for what the world may refuse; raises UsageError with its reason then.
    void command(const char* call, const std::function<void(scene::Simulation&)>& work);

    /// What never changes and is read without a lock.
    [[nodiscard]] const scene::Simulation& facts() const { return *simulation_; }
    [[nodiscard]] const std::vector<RagdollPointer>& assets() const { return assets_; }
    [[nodiscard]] RagdollPointer ragdollOf(int doll) const;
    /// The bodies of all dolls now, in their place for the simulation's life.
    [[nodiscard]] std::span<const RigidTransform> bodies();
    [[nodiscard]] std::span<const RigidTransform> bodies(int doll);

    /// Raises UsageError when there is no such doll; its number as it is otherwise.
    int checkedDoll(const char* call, int doll) const;
    /// Index of a doll's body, told by name or number; likewise.
    [[nodiscard]] int checkedBody(const char* call, int doll, const py::object& body) const;

    void reset();
    /// How often it was reset: what was made in the world before means nothing after.
    [[nodiscard]] int resets() const { return resets_; }

  private:
    std::vector<RagdollPointer> assets_;
    std::unique_ptr<scene::Simulation> simulation_;  // of these assets, which outlive it
    std::mutex mutex_;
    std::atomic<int> resets_ = 0;
};
using SimulationPointer = std::shared_ptr<SimulationObject>;

/// A simulation of a named scene, of the keywords that `lutka.Simulation()` takes.
[[nodiscard]] SimulationPointer makeSimulation(const RagdollObject& ragdoll, const std::string& scene,
                                               const py::kwargs& given);
/// Of a scene file, which names its characters; those without a model take `model`.
[[nodiscard]] SimulationPointer loadSimulation(const std::filesystem::path& file, const std::filesystem::path& model,
                                               const py::kwargs& given);

void bindSimulation(py::module_& module);

}  // namespace lutka::python
