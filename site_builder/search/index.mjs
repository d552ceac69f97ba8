/**
 * Makes the index of the search: sections as JSON on standard input, the index on standard output.
 *
 * Arguments: the files of MiniSearch, of the stemmer, and of the book's own ranking.
 */

import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [library, stemmer, ranking] = process.argv.slice(2).map((path) => pathToFileURL(path).href);
const { default: MiniSearch } = await import(library);
const { stemmer: stem } = await import(stemmer);
const { settings } = await import(ranking);

const index = new MiniSearch(settings(stem));
index.addAll(JSON.parse(readFileSync(0, "utf8")));
process.stdout.write(JSON.stringify(index));
