import { defineConfig } from "vite";

// One page, served from the program's own memory under a strict content security policy: nothing inline.
export default defineConfig({
  base: "/",
  build: { target: "es2022", assetsInlineLimit: 0, modulePreload: { polyfill: false } },
});
