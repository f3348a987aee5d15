# Python and pybind11. Debian's own Python is preferred: it finds Debian's numpy and pybind11. Another
# one is chosen by -DPython_EXECUTABLE=... .
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 REQUIRED)
# As numpy_below in values/arrays.h.
set(BOULE_NUMPY_BELOW 3 CACHE INTERNAL "The first major version of numpy that is too new")
if(pybind11_VERSION VERSION_LESS 2.12)
  set(BOULE_NUMPY_BELOW 2 CACHE INTERNAL "")
endif()
