#include <exception>
#include <stdexcept>

#include "bindings.hpp"
#include "tanglebin/base/error.hpp"

namespace tanglebin::python {
namespace {

// The module's exception classes; they live as long as the process.
py::handle input_error;
py::handle system_error;

void raise_input_error(const InputError& error) {
  const py::object raised = input_error(error.what());
  raised.attr("file") = error.place().file;
  raised.attr("line") = error.place().line;
  raised.attr("field") = error.place().field;
  raised.attr("problem") = error.problem();
  PyErr_SetObject(input_error.ptr(), raised.ptr());
}

}  // namespace

void bind_errors(py::module_& module) {
  py::exception<InputError> input(module, "InputError", PyExc_ValueError);
  input.doc() = doc::base::InputError;
  input.attr("__annotations__") = py::dict(py::arg("file") = "str", py::arg("line") = "int",
                                           py::arg("field") = "str", py::arg("problem") = "str");
  input_error = input.release();
  py::exception<SystemError> system(module, "SystemError", PyExc_OSError);
  system.doc() = doc::base::SystemError;
  system_error = system.release();

  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise_input_error(error);
    } catch (const std::invalid_argument& error) {  // an argument that breaks what a function asks for
      raise_input_error(InputError({}, error.what()));
    } catch (const SystemError& error) {
      PyErr_SetString(system_error.ptr(), error.what());
    }
  });
}

}  // namespace tanglebin::python
