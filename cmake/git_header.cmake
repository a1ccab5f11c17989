# Run at every build: writes OUT (volumark_git.h) from the repository at SOURCE; untouched where nothing changed.
function(git result)
  execute_process(COMMAND git -C ${SOURCE} ${ARGN} OUTPUT_VARIABLE text ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE
                  RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    set(text "")
  endif()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()
git(sha rev-parse HEAD)
git(branch rev-parse --abbrev-ref HEAD)
git(date log -1 --format=%cI)
git(changes status --porcelain --untracked-files=no)
set(dirty false)
if(NOT changes STREQUAL "")
  set(dirty true)
endif()
set(text "// Made at build time: the commit that this program was built from.
#pragma once

namespace volumark {
inline constexpr const char* kGitSha = \"${sha}\";
inline constexpr const char* kGitBranch = \"${branch}\";
inline constexpr const char* kGitDate = \"${date}\";
inline constexpr bool kGitDirty = ${dirty};
}  // namespace volumark
")
set(old "")
if(EXISTS ${OUT})
  file(READ ${OUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUT} "${text}")
endif()
