/**
 * Light, dark, or as the system says; remembered. The inline script at the top of each page
 * applies the remembered theme before the first paint.
 */

import { STORAGE } from "../book.js";
import { all, within } from "./dom.ts";
import { words } from "./words.ts";

type Theme = "system" | "light" | "dark";

const KEY = `${STORAGE}theme`;
const NEXT: Record<Theme, Theme> = { system: "light", light: "dark", dark: "system" };

/** Listen for the theme button on any page. */
export function installTheme() {
  document.addEventListener("click", (event) => {
    if (!within(event, ".theme-toggle", Element)) return;
    setTheme(NEXT[currentTheme()]);
    showTheme();
  });
  showTheme();
}

/** Let every theme button say which theme is on. */
export function showTheme() {
  const name = words(`theme.${currentTheme()}`);
  for (const button of all(document, ".theme-toggle", HTMLButtonElement)) {
    button.dataset.choice = currentTheme();
    button.setAttribute("aria-label", words("theme.label", { name }));
    button.title = words("theme.title", { name });
  }
}

function currentTheme(): Theme {
  const theme = document.documentElement.dataset.theme;
  return theme === "light" || theme === "dark" ? theme : "system";
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
