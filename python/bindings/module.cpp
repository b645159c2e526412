#include <pybind11/pybind11.h>

#include "bindings/profile_object.hpp"
#include "bindings/ragdoll_object.hpp"
#include "bindings/simulation_object.hpp"

PYBIND11_MODULE(_lutka, module) {
    module.doc() = "The compiled part of lutka.";
    module.attr("__version__") = LUTKA_VERSION;
    lutka::python::bindProfile(module);
    lutka::python::bindRagdoll(module);
    lutka::python::bindSimulation(module);
}
