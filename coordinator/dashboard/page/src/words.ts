// What the page says, in the language that was chosen, and how it writes numbers and times.
import { de } from "./words_de";
import { en, type Word } from "./words_en";

export type { Word };

const tables = { en, de };
export type Language = keyof typeof tables;

let language: Language =
  (localStorage.getItem("language") as Language | null) ?? (navigator.language.startsWith("de") ? "de" : "en");

export function currentLanguage(): Language {
  return language;
}

export function setLanguage(next: Language): void {
  language = next;
  localStorage.setItem("language", next);
}

export function say(word: Word, ...values: (string | number)[]): string {
  return tables[language][word].replace(/\{(\d)\}/g, (_, i: string) => String(values[Number(i)]));
}

export function decimals(value: number, digits: number): string {
  return value.toLocaleString(language, { minimumFractionDigits: digits, maximumFractionDigits: digits });
}

/// "14 s", "3 min", "2 h 5 min".
export function duration(seconds: number): string {
  const s = Math.max(0, Math.floor(seconds));
  if (s < 100) return `${s} s`;
  if (s < 6000) return `${Math.floor(s / 60)} min`;
  return `${Math.floor(s / 3600)} h ${Math.floor((s % 3600) / 60)} min`;
}

export function clock(seconds: number): string {
  const s = Math.max(0, Math.floor(seconds));
  const two = (n: number) => String(n).padStart(2, "0");
  return `${two(Math.floor(s / 3600))}:${two(Math.floor(s / 60) % 60)}:${two(s % 60)}`;
}
