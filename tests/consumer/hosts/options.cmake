# include_options: the folders INCLUDE as the compiler's options.
set(include_options "")
foreach(folder IN LISTS INCLUDE)
  # Naming a compiler's own folder again would change the order of its search.
  if(folder AND NOT folder STREQUAL "/usr/include")
    list(APPEND include_options "-I${folder}")
  endif()
endforeach()
