# Flags of the presets asan, tsan and fuzz; see README.md beside this file.
if (NOT PARTICLEOCCLUSION_SANITIZERS AND NOT PARTICLEOCCLUSION_FUZZERS)
  return()
endif ()
if (NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
  message(FATAL_ERROR "PARTICLEOCCLUSION_SANITIZERS and PARTICLEOCCLUSION_FUZZERS need Clang: "
    "configure with the presets asan, tsan or fuzz")
endif ()

if (PARTICLEOCCLUSION_SANITIZERS)
  list(JOIN PARTICLEOCCLUSION_SANITIZERS "," sanitizers)
  # Any finding ends the test.
  add_compile_options(
    -fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer -gline-tables-only)
  add_link_options(-fsanitize=${sanitizers})
  add_compile_definitions(PARTICLEOCCLUSION_SANITIZED)
endif ()

if (thread IN_LIST PARTICLEOCCLUSION_SANITIZERS)
  # The library TBB is not instrumented, so neither are its headers; what it guarantees is told to
  # the sanitizer in headers that are found before TBB's own.
  add_compile_options(-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/thread-ignore.txt)
  include_directories(BEFORE "${CMAKE_CURRENT_LIST_DIR}/thread")
endif ()

if (PARTICLEOCCLUSION_FUZZERS)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif ()
