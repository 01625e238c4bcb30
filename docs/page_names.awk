# Doxygen reads the pages through this. It names each page after its file, page_getting_started, and turns links to
# pages into references to these names. Left to itself, Doxygen 1.9 refers to a page by its path, unquoted, and a path
# with a space in it ends there.

function page(path) {
    sub(/.*\//, "", path)
    sub(/\.md$/, "", path)
    gsub(/-/, "_", path)
    return path == "README" ? "index" : "page_" path
}

FNR == 1 && /^# / && page(FILENAME) != "index" { $0 = $0 " {#" page(FILENAME) "}" }

{
    rest = $0
    while (match(rest, /\]\([A-Za-z_.\/-]*\.md\)/)) {
        printf "%s@ref %s)", substr(rest, 1, RSTART + 1), page(substr(rest, RSTART + 2, RLENGTH - 3))
        rest = substr(rest, RSTART + RLENGTH)
    }
    print rest
}
