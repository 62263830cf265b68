# Writes PAGES: files that PROGRAM makes for man, the shells and editors.
file(REMOVE_RECURSE ${PAGES})
file(MAKE_DIRECTORY ${PAGES})
execute_process(COMMAND ${PROGRAM} man -o ${PAGES}/man1 COMMAND_ERROR_IS_FATAL ANY)
file(GLOB manual ${PAGES}/man1/*)
execute_process(COMMAND gzip -9n ${manual} COMMAND_ERROR_IS_FATAL ANY) # -n: no time, the same bytes
foreach(made "completion;bash;frictab" "completion;zsh;_frictab" "completion;fish;frictab.fish"
             "schema;job.schema.json")
  list(POP_BACK made file)
  execute_process(COMMAND ${PROGRAM} ${made} OUTPUT_FILE ${PAGES}/${file}
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()
