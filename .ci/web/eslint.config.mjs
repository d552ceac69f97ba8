/** What is looked for in scripts and style sheets. Types are TypeScript's to check, form Prettier's. */

import css from "@eslint/css";
import js from "@eslint/js";
import jsdoc from "eslint-plugin-jsdoc";
import globals from "globals";

const WORKER = [
  "static/js/runtime/worker.js",
  "static/js/runtime/chunks.js",
  "static/js/offline/service_worker.js",
];

export default [
  { files: ["**/*.js", "**/*.mjs"], ...js.configs.recommended },
  {
    files: ["**/*.js", "**/*.mjs"],
    languageOptions: { globals: globals.browser },
    plugins: { jsdoc },
    rules: {
      eqeqeq: "error",
      "no-var": "error",
      "prefer-const": "error",
      "no-undef": "off", // TypeScript knows better what a page and a worker have
      "jsdoc/check-alignment": "error",
      "jsdoc/check-param-names": "error",
      "jsdoc/check-tag-names": ["error", { definedTags: ["import"] }],
      "jsdoc/multiline-blocks": ["error", { noMultilineBlocks: false }],
      "jsdoc/no-bad-blocks": "error",
      "jsdoc/no-multi-asterisks": "error",
      "jsdoc/require-param": "error",
      "jsdoc/require-param-name": "error",
      "jsdoc/require-param-type": "error",
      "jsdoc/require-returns-type": "error",
      "jsdoc/tag-lines": ["error", "never", { startLines: 1 }],
    },
  },
  { files: WORKER, languageOptions: { globals: globals.worker } },
  {
    files: ["**/*.css"],
    plugins: { css },
    language: "css/css",
    rules: {
      ...css.configs.recommended.rules,
      "css/no-important": "off", // print and [hidden] must win
      "css/no-invalid-properties": ["error", { allowUnknownVariables: true }], // of other files
      "css/use-baseline": "off", // what is new is an extra that pages do without
    },
  },
];
