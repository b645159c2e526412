"""Lutka's default character, made from nothing but the numbers in this package."""
