# Finds a C++ compiler that has the vectors which the kernels are written in, or says in a sentence what is missing.
string(CONCAT remedy
  "Install GCC 12, Clang 15 or a newer one (Debian: apt-get install g++; macOS: xcode-select --install; Windows: Visual "
  "Studio with its component C++ Clang tools)")

# Looked for before it is asked for, because CMake itself would fill a page.
include(CheckLanguage)
check_language(CXX)
if(NOT CMAKE_CXX_COMPILER)
  set(named "")
  if(NOT "$ENV{CXX}" STREQUAL "")
    set(named " (CXX names $ENV{CXX})")
  endif()
  message(FATAL_ERROR "hexmend: the kernels are built from C++, and no compiler for it was found${named}. "
                      "${remedy}, or name one: CXX=/path/to/compiler")
endif()
enable_language(CXX)

set(oldest_GNU 12)
set(oldest_Clang 15)
set(oldest_AppleClang 15)
set(oldest "${oldest_${CMAKE_CXX_COMPILER_ID}}")
if(NOT oldest OR CMAKE_CXX_COMPILER_VERSION VERSION_LESS oldest)
  message(FATAL_ERROR "hexmend: the kernels need vectors that the C++ compiler ${CMAKE_CXX_COMPILER} "
                      "(${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}) does not have. "
                      "${remedy}, or name another: CXX=/path/to/compiler")
endif()
