# Writes OUTPUT, a C++ file in which sim::NAME, which HEADER declares, is the content of FILE:
# cmake -D NAME -D FILE -D HEADER -D OUTPUT -P embed.cmake. An empty FILE gives an empty text.
set(bytes "")
if(FILE)
  file(READ ${FILE} hex HEX)
  string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${hex}")
endif()
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

namespace {
constexpr char bytes_of_${NAME}[] = {${bytes}'\\0'};
}  // namespace

namespace sim {
const std::string_view ${NAME}{bytes_of_${NAME}, sizeof bytes_of_${NAME} - 1};
}  // namespace sim
")
