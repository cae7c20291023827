// Light or dark: the system's choice until the reader makes one.
const root = document.documentElement;
const systemIsDark = matchMedia("(prefers-color-scheme: dark)");
const themeListeners = [];

const isDark = () => (root.dataset.theme ? root.dataset.theme === "dark" : systemIsDark.matches);

// The colour that a name of page.css has now; a canvas does not know of names.
const known = new Map();
function themed(name) {
  if (!known.has(name)) {
    root.style.setProperty("outline-color", `var(--${name})`);
    known.set(name, getComputedStyle(root).outlineColor);
  }
  return known.get(name);
}

function themeChanged() {
  known.clear();
  document.getElementById("theme").textContent = isDark() ? "Light" : "Dark";
  document.getElementById("theme").setAttribute("aria-label", `Switch to ${isDark() ? "light" : "dark"} colours`);
  themeListeners.forEach((listener) => listener());
}

function startTheme() {
  document.getElementById("theme").addEventListener("click", () => {
    root.dataset.theme = isDark() ? "light" : "dark";
    themeChanged();
  });
  systemIsDark.addEventListener("change", themeChanged);
  themeChanged();
}
