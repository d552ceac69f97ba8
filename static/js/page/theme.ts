/**
 * Light, dark, or the theme of the system; stored. The inline script at the top of each page
 * applies the stored theme before the first paint.
 */

import { STORAGE } from "../book.js";
import { findAll, closestTo } from "./dom.ts";
import { words } from "./words.ts";

type Theme = "system" | "light" | "dark";

const KEY = `${STORAGE}theme`;
const DARK = matchMedia("(prefers-color-scheme: dark)");

/** Listen for the theme button on any page. */
export function install() {
  document.addEventListener("click", (event) => {
    if (!closestTo(event, ".theme-toggle", Element)) return;
    setTheme(nextTheme());
    setUpPage();
  });
}

/** Show the present theme on every theme button. */
export function setUpPage() {
  const name = words(`theme.${currentTheme()}`);
  for (const button of findAll(document, ".theme-toggle", HTMLButtonElement)) {
    button.dataset.choice = currentTheme();
    button.setAttribute("aria-label", words("theme.label", { name }));
    button.title = words("theme.title", { name });
  }
}

function currentTheme(): Theme {
  const theme = document.documentElement.dataset.theme;
  return theme === "light" || theme === "dark" ? theme : "system";
}

/** The order of themes: the system's, the other one, the first by choice, and the system's again. */
function nextTheme(): Theme {
  const [same, other]: Theme[] = DARK.matches ? ["dark", "light"] : ["light", "dark"];
  return { system: other, [other]: same, [same]: "system" as const }[currentTheme()];
}

function setTheme(theme: Theme) {
  if (theme === "system") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  try {
    if (theme === "system") localStorage.removeItem(KEY);
    else localStorage.setItem(KEY, theme);
  } catch {
    // Storage is blocked: the choice lasts until the page is left.
  }
}
