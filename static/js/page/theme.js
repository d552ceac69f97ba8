/**
 * Light, dark, or as the system says; remembered. The inline script at the top of each page
 * applies the remembered theme before the first paint.
 */

const KEY = "theme";
const NAMES = { system: "System", light: "Light", dark: "Dark" };
const NEXT = { system: "light", light: "dark", dark: "system" };

/** Listen for the theme button on any page. */
export function installTheme() {
  document.addEventListener("click", (event) => {
    if (!event.target.closest?.(".theme-toggle")) return;
    setTheme(NEXT[currentTheme()]);
    showTheme();
  });
  showTheme();
}

/** Let every theme button say which theme is on. */
export function showTheme() {
  const name = NAMES[currentTheme()];
  for (const button of document.querySelectorAll(".theme-toggle")) {
    button.dataset.choice = currentTheme();
    button.setAttribute("aria-label", `Theme: ${name}. Press to change.`);
    button.title = `Theme: ${name}`;
  }
}

/** @returns {"system" | "light" | "dark"} */
function currentTheme() {
  const theme = document.documentElement.dataset.theme;
  return theme === "light" || theme === "dark" ? theme : "system";
}

/** @param {"system" | "light" | "dark"} theme */
function setTheme(theme) {
  if (theme === "system") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  try {
    if (theme === "system") localStorage.removeItem(KEY);
    else localStorage.setItem(KEY, theme);
  } catch {
    // Storage is blocked: the choice lasts until the page is left.
  }
}
