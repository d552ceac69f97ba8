"""Which scripts a page's head names: all that its first script imports, and no later ones."""

from site_builder.output.scripts import imported_scripts

FILES = {
    "js/main.js": b'import { a } from "./page/a.js";\nimport {\n  b,\n  c,\n} from "./b.js";\n',
    "js/page/a.js": b'export { d } from "../d.js";\nconst later = () => import("./later.js");\n',
    "js/b.js": b'/** @import { T } from "./types.js" */\nimport { a } from "./page/a.js";\n',
    "js/d.js": b"export const d = 1;\n",
}


def test_imports_are_followed_and_what_comes_later_is_left_out() -> None:
    assert imported_scripts(FILES, "js/main.js") == ("js/page/a.js", "js/b.js", "js/d.js")
