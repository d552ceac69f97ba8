/** In place of a stemmer: a word is itself. @param {string} word */
export const stemmer = (word) => word;
