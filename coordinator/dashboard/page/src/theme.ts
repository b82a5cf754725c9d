// Night, day and high contrast.
import type { Palette } from "./tiles";

export const THEMES = ["night", "day", "contrast"] as const;
export type Theme = (typeof THEMES)[number];

export interface MapColours extends Palette {
  unknown: string;
  hatch: string;
  ink: string;
  paper: string;
}

const COLOURS: Record<Theme, MapColours> = {
  night: { free: [58, 74, 94], wall: [240, 244, 248], unknown: "#0c1016", hatch: "#1f2833", ink: "#ffffff", paper: "#000000" },
  day: { free: [255, 255, 255], wall: [17, 17, 17], unknown: "#c3c9d1", hatch: "#a4acb7", ink: "#000000", paper: "#ffffff" },
  contrast: { free: [0, 62, 140], wall: [255, 255, 0], unknown: "#000000", hatch: "#5a5a5a", ink: "#ffffff", paper: "#000000" },
};

let theme: Theme = (localStorage.getItem("theme") as Theme | null) ?? "night";
if (!THEMES.includes(theme)) theme = "night";

export function currentTheme(): Theme {
  return theme;
}
export function colours(): MapColours {
  return COLOURS[theme];
}
export function setTheme(next: Theme): void {
  theme = next;
  localStorage.setItem("theme", next);
  document.documentElement.dataset["theme"] = next;
}
