// What servers that render pages get in place of the elements: nothing, as they draw nothing.
export {};
